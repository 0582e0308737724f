/*
 * Times of CHOLMOD with METIS for one symmetric matrix, as JSON.
 *
 * cholmod FILE wall|cpu
 *
 * FILE, in the machine's byte order: n, entries, right-hand sides and a zero as 32-bit numbers; offsets of the n columns and
 * the end; row of every entry; a zero where that makes an odd count of 32-bit numbers; values and right-hand sides as doubles.
 * Both triangles are stored.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>
#include <time.h>

static clockid_t clock_id = CLOCK_MONOTONIC;

static double now(void) {
    struct timespec t;
    clock_gettime(clock_id, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void fail(const char *text) {
    fprintf(stderr, "%s\n", text);
    exit(1);
}

static void *take(FILE *file, size_t count, size_t size) {
    void *data = malloc(count * size + 1);
    if (!data || fread(data, size, count, file) != count) fail("the matrix cannot be read");
    return data;
}

/* The lower triangle, which is all that CHOLMOD reads of a symmetric matrix. */
static cholmod_sparse *lower(FILE *file, uint32_t n, uint32_t entries, cholmod_common *common) {
    uint32_t *offsets = take(file, n + 1, sizeof *offsets);
    uint32_t *rows = take(file, entries, sizeof *rows);
    if ((n + 1 + entries) % 2) free(take(file, 1, sizeof *rows));
    double *values = take(file, entries, sizeof *values);
    cholmod_sparse *matrix = cholmod_allocate_sparse(n, n, (entries + n) / 2, 1, 1, -1, CHOLMOD_REAL, common);
    if (!matrix) fail("out of memory");
    int32_t *to_offsets = matrix->p, *to_rows = matrix->i, end = 0;
    double *to_values = matrix->x;
    for (uint32_t column = 0; column < n; column++) {
        to_offsets[column] = end;
        for (uint32_t k = offsets[column]; k < offsets[column + 1]; k++) {
            if (rows[k] < column) continue;
            to_rows[end] = (int32_t)rows[k];
            to_values[end++] = values[k];
        }
    }
    to_offsets[n] = end;
    free(offsets);
    free(rows);
    free(values);
    return matrix;
}

int main(int count, char **arguments) {
    if (count != 3) fail("cholmod FILE wall|cpu");
    if (!strcmp(arguments[2], "cpu")) clock_id = CLOCK_PROCESS_CPUTIME_ID;
    FILE *file = fopen(arguments[1], "rb");
    if (!file) fail("the matrix cannot be opened");
    uint32_t *header = take(file, 4, sizeof *header);
    uint32_t n = header[0], columns = header[2];

    cholmod_common common;
    cholmod_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_METIS;
    common.postorder = 1;
    cholmod_sparse *matrix = lower(file, n, header[1], &common);
    cholmod_dense *b = cholmod_allocate_dense(n, columns, n, CHOLMOD_REAL, &common);
    free(b->x);
    b->x = take(file, (size_t)n * columns, sizeof(double));
    cholmod_dense *one = cholmod_zeros(n, 1, CHOLMOD_REAL, &common);
    memcpy(one->x, b->x, n * sizeof(double));

    double start = now();
    cholmod_factor *factor = cholmod_analyze(matrix, &common);
    double analyse = now() - start;
    if (common.status != CHOLMOD_OK || common.selected < 0) fail("CHOLMOD cannot analyse the matrix with METIS");
    double nonzeros = common.lnz;
    start = now();
    cholmod_factorize(matrix, factor, &common);
    double numeric = now() - start;
    if (common.status != CHOLMOD_OK) fail("the matrix is not positive definite");
    start = now();
    cholmod_dense *x = cholmod_solve(CHOLMOD_A, factor, one, &common);
    double solve = now() - start;
    start = now();
    cholmod_dense *xs = cholmod_solve(CHOLMOD_A, factor, b, &common);
    double solve_all = now() - start;
    start = now();
    cholmod_factorize(matrix, factor, &common);
    double refactor = now() - start;

    double sum = 0;
    for (uint32_t i = 0; i < n; i++) sum += ((double *)x->x)[i];
    printf("{\"analyse\":%.6f,\"factor\":%.6f,\"refactor\":%.6f,\"solve1\":%.6f,\"solve%u\":%.6f,"
           "\"nonzeros\":%.0f,\"supernodal\":%s,\"sum\":%.17g}\n",
           analyse, numeric, refactor, solve, columns, solve_all, nonzeros, factor->is_super ? "true" : "false", sum);
    cholmod_free_dense(&xs, &common);
    return 0;
}
