/* What another precision or time step costs and errs: pairs of measured runs (bench/results/accuracy-curves.csv) that
 * differ in nothing else. */
#ifndef BRC_COMMANDS_PRICE_CHOICES_H
#define BRC_COMMANDS_PRICE_CHOICES_H

#define BRC_CHOICES_MOST 8

typedef struct brc_price_choice {
    char value[16];    /* "single", "0.95" */
    int pairs;         /* of runs: with this value and with the usual one */
    double time;       /* of running, building apart, over that of the usual choice: sum over sum of the pairs [-] */
    double more_error; /* largest amount by which the relative error is above that of the partner; 0: nowhere [-] */
} brc_price_choice;

/* Choices in a column ("precision", "dt_fraction") beside the usual one ("double", "0.8") with runs of a model
 * ("dlsm"), in the order of the text; *n of them, 0: none was measured. text: CSV with a header line. */
void brc_price_choices_read(const char *text, const char *model, const char *column, const char *usual, int *n,
                            brc_price_choice out[BRC_CHOICES_MOST]);
/* The quickest of them that errs by no more than `error` [-] more and takes less time than the usual one; -1: the usual
 * one. */
int brc_price_choice_best(int n, const brc_price_choice *choice, double error);

#endif
