/* What a device is, and how it takes arguments. */
#include "device_internal.h"

static const struct {
    const char *name;
    int state_bytes, coeff_bytes;
} precisions[] = {[BRC_DOUBLE] = {"double", 8, 8}, [BRC_MIXED] = {"mixed", 8, 4}, [BRC_SINGLE] = {"single", 4, 4}};

int brc_precision_state_bytes(brc_precision precision)
{
    return precisions[precision].state_bytes;
}

int brc_precision_coeff_bytes(brc_precision precision)
{
    return precisions[precision].coeff_bytes;
}

const char *brc_precision_name(brc_precision precision)
{
    return precisions[precision].name;
}

const brc_device_info *brc_device_get_info(const brc_device *device)
{
    return &device->info;
}

brc_packed_arg brc_arg_pack(const brc_device *device, const brc_arg *arg)
{
    brc_packed_arg packed;
    int bytes = 8;
    switch (arg->kind) {
    case BRC_ARG_BUFFER:
        packed.value.memory = arg->value.buffer ? arg->value.buffer->memory : device->dummy;
        packed.bytes = sizeof(void *);
        packed.type = 'p';
        return packed;
    case BRC_ARG_INT:
        packed.value.integer = arg->value.integer;
        packed.bytes = sizeof(int32_t);
        packed.type = 'i';
        return packed;
    case BRC_ARG_STATE: bytes = precisions[device->precision].state_bytes; break;
    case BRC_ARG_COEFF: bytes = precisions[device->precision].coeff_bytes; break;
    default: break;
    }
    if (bytes == 8)
        packed.value.dbl = arg->value.real;
    else
        packed.value.single = (float)arg->value.real;
    packed.bytes = (size_t)bytes;
    packed.type = bytes == 8 ? 'd' : 'f';
    return packed;
}
