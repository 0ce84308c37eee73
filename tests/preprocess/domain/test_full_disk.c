/* A full disk, a real one of 100 kB, in a child with a mount of its own: a program of its own, which skips visibly (77)
 * where mounting is not allowed, as in many containers; under BRC_NO_SKIPS too, since no package brings that right. */
#include "../support.h"

#include "../../../host/base/log.h"
#include "../../../preprocess/domain/domain_file.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* The child ends as a program does, so that what libraries do at the end is seen too. 77: no mount. */
static int write_to_a_full_disk(void)
{
    if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) _exit(77);
    if (mount("none", "/", NULL, MS_REC | MS_PRIVATE, NULL) != 0) _exit(77);
    if (mount("none", "small_disk", "tmpfs", 0, "size=100k,mode=777") != 0) _exit(77);
    brc_context *context = brc_context_create();
    brc_log_set_level(context, BRC_LOG_ERROR);
    const brc_build_request request = test_cylinder(300, 0.9);
    brc_domain *d = test_build(context, &request);
    const brc_status status = brc_domain_write(context, d, "small_disk/d.h5");
    const bool said = strstr(brc_context_message(context), "No space left on device") != NULL;
    if (!said) fprintf(stderr, "%s\n", brc_context_message(context));
    const bool rest = access("small_disk/d.h5", F_OK) == 0 || access("small_disk/d.h5.part", F_OK) == 0;
    brc_domain_free(&d);
    brc_context_free(&context);
    return status == BRC_FILE_FAILED && said && !rest ? 0 : 1;
}

static int result;

static void a_really_full_disk_leaves_a_clean_exit(void **state)
{
    (void)state;
    assert_true(WIFEXITED(result));
    assert_int_equal(WEXITSTATUS(result), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_really_full_disk_leaves_a_clean_exit),
    };
    mkdir("small_disk", 0777);
    const pid_t child = fork();
    if (child == 0) exit(write_to_a_full_disk());
    if (child < 0 || waitpid(child, &result, 0) != child) return 1;
    rmdir("small_disk");
    if (WIFEXITED(result) && WEXITSTATUS(result) == 77) {
        printf("SKIPPED: mounting is not allowed here\n");
        return 77;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
