/* The file driver: POSIX calls and the memory of the first refusal. */
#include "h5_disk.h"
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct disk_file {
    H5FD_t base; /* HDF5's part, first */
    brc_h5_disk *disk;
    int descriptor;
    haddr_t end_asked, end_written; /* [byte] */
} disk_file;

static void remember(brc_h5_disk *disk)
{
    if (disk->error == 0) disk->error = errno ? errno : EIO;
}

static H5FD_t *open_disk(const char *name, unsigned flags, hid_t access, haddr_t largest)
{
    (void)flags; /* only ever created */
    (void)largest;
    brc_h5_disk *const *disk = H5Pget_driver_info(access);
    disk_file *file = disk ? calloc(1, sizeof *file) : NULL;
    if (!file) return NULL;
    file->disk = *disk;
    file->descriptor = open(name, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file->descriptor >= 0) return &file->base;
    remember(file->disk);
    free(file);
    return NULL;
}

static herr_t close_disk(H5FD_t *base)
{
    disk_file *file = (disk_file *)base;
    if (close(file->descriptor) != 0) remember(file->disk);
    free(file);
    return 0;
}

/* H5Fcreate asks whether the file is open already; every file here is one of its own. */
static int compare(const H5FD_t *a, const H5FD_t *b)
{
    return a < b ? -1 : a > b;
}

static herr_t query(const H5FD_t *base, unsigned long *features)
{
    (void)base;
    *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

static haddr_t get_eoa(const H5FD_t *base, H5FD_mem_t type)
{
    (void)type;
    return ((const disk_file *)base)->end_asked;
}

static herr_t set_eoa(H5FD_t *base, H5FD_mem_t type, haddr_t address)
{
    (void)type;
    ((disk_file *)base)->end_asked = address;
    return 0;
}

static haddr_t get_eof(const H5FD_t *base, H5FD_mem_t type)
{
    (void)type;
    return ((const disk_file *)base)->end_written;
}

static herr_t read_disk(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, void *buffer)
{
    (void)type;
    (void)transfer;
    disk_file *file = (disk_file *)base;
    size_t done = 0;
    while (done < size) {
        const ssize_t got = pread(file->descriptor, (char *)buffer + done, size - done, (off_t)(address + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) remember(file->disk);
        if (got <= 0) break;
        done += (size_t)got;
    }
    memset((char *)buffer + done, 0, size - done); /* beyond the end a file is zero */
    return 0;
}

static herr_t write_disk(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size,
                         const void *buffer)
{
    (void)type;
    (void)transfer;
    disk_file *file = (disk_file *)base;
    size_t done = 0;
    while (done < size && file->disk->error == 0) {
        const ssize_t put = pwrite(file->descriptor, (const char *)buffer + done, size - done, (off_t)(address + done));
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0)
            remember(file->disk);
        else
            done += (size_t)put;
    }
    if (address + size > file->end_written) file->end_written = address + size;
    return 0;
}

static herr_t truncate_disk(H5FD_t *base, hid_t transfer, hbool_t closing)
{
    (void)transfer;
    (void)closing;
    disk_file *file = (disk_file *)base;
    if (file->end_asked == file->end_written) return 0;
    if (file->disk->error == 0 && ftruncate(file->descriptor, (off_t)file->end_asked) != 0) remember(file->disk);
    file->end_written = file->end_asked;
    return 0;
}

hid_t brc_h5_disk_begin(brc_h5_disk *disk)
{
    const H5FD_class_t class = {
#if H5_VERSION_GE(1, 13, 0)
        .version = H5FD_CLASS_VERSION,
        .value = (H5FD_class_value_t)600, /* in the range HDF5 leaves to programs */
#endif
        .name = "breccia disk",
        .maxaddr = ((haddr_t)1 << 62) - 1,
        .fc_degree = H5F_CLOSE_STRONG,
        .fapl_size = sizeof disk,
        .open = open_disk,
        .close = close_disk,
        .cmp = compare,
        .query = query,
        .get_eoa = get_eoa,
        .set_eoa = set_eoa,
        .get_eof = get_eof,
        .read = read_disk,
        .write = write_disk,
        .truncate = truncate_disk,
        .fl_map = H5FD_FLMAP_DICHOTOMY,
    };
    disk->error = 0;
    disk->driver = H5FDregister(&class);
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (disk->driver >= 0 && access >= 0 && H5Pset_driver(access, disk->driver, &disk) >= 0) return access;
    if (access >= 0) H5Pclose(access);
    brc_h5_disk_end(disk);
    return H5I_INVALID_HID;
}

void brc_h5_disk_end(brc_h5_disk *disk)
{
    if (disk->driver > 0) H5FDunregister(disk->driver);
    disk->driver = 0;
}
