# Sourced by test_*.sh: quick CASE [options] runs the quick rows of a case in a folder of its own and shows them.
# OpenMP may not spin: several tests share the cores.
quick() {
    program=${BRC_PROGRAM:-breccia}
    folder=validation-$1-$$
    OMP_WAIT_POLICY=passive "$program" reproduce "$@" --quick -o "$folder"
    code=$?
    [ $code = 0 ] && rm -rf "$folder"
    exit $code
}
