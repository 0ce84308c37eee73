/* h5_numbers FILE GROUP: one line a dataset below GROUP, sorted by name: name, bytes a number, numbers, hash of the
 * numbers (FNV-1a, 64 bits). Links to other files are followed. */
#include <hdf5.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static uint64_t hash_of(const unsigned char *bytes, size_t n)
{
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < n; ++i)
        hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash;
}

static int print_dataset(hid_t dataset, const char *group, const char *name)
{
    const hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset);
    const size_t size = H5Tget_size(type);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    unsigned char *const bytes = n >= 0 ? calloc((size_t)n + 1, size) : NULL;
    const int ok =
        bytes && !H5Tis_variable_str(type) && H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes) >= 0;
    if (ok)
        printf("%s/%s %zu %lld %016" PRIx64 "\n", group, name, size, (long long)n, hash_of(bytes, (size_t)n * size));
    else
        fprintf(stderr, "%s/%s: cannot be read as plain numbers\n", group, name);
    free(bytes);
    H5Sclose(space);
    H5Tclose(type);
    return ok ? 0 : 1;
}

/* Objects are opened by name, not visited, since a visit does not follow links to other files. */
static int print_group(hid_t group, const char *path)
{
    H5G_info_t info;
    int failures = H5Gget_info(group, &info) < 0;
    for (hsize_t i = 0; !failures && i < info.nlinks; ++i) {
        char name[256], below[1024];
        if (H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT) < 0) return 1;
        const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
        const H5I_type_t kind = object < 0 ? H5I_BADID : H5Iget_type(object);
        snprintf(below, sizeof below, "%s/%s", path, name);
        if (kind == H5I_DATASET)
            failures += print_dataset(object, path, name);
        else if (kind == H5I_GROUP)
            failures += print_group(object, below);
        else {
            fprintf(stderr, "%s: neither a group nor a dataset\n", below);
            failures += 1;
        }
        if (object >= 0) H5Oclose(object);
    }
    return failures;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "h5_numbers FILE GROUP\n");
        return 2;
    }
    const hid_t file = H5Fopen(argv[1], H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t group = file < 0 ? -1 : H5Gopen2(file, argv[2], H5P_DEFAULT);
    const int failures = group < 0 ? 1 : print_group(group, argv[2]);
    if (group < 0) fprintf(stderr, "%s: no group %s in it\n", argv[1], argv[2]);
    if (group >= 0) H5Gclose(group);
    if (file >= 0) H5Fclose(file);
    return failures ? 1 : 0;
}
