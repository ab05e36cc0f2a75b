#define _GNU_SOURCE
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include "five_bar.h"

enum { SIZE = 1 << 18 };
static unsigned char stack[SIZE] __attribute__((aligned(4096)));
static double q[] = {1.9, 1.1}, qd[] = {1.0, 1.0}, qdd[] = {1.0, 1.0};
static double beta[FIVE_BAR_BASE_PARAMETERS], out[1024];

static void *nothing(void *x) { return x; }
static void *torque(void *x) { five_bar_inverse_dynamics(q, qd, qdd, beta, out); return x; }
static void *rows(void *x) { five_bar_regressor(q, qd, qdd, out); return x; }

static int used(void *(*run)(void *))
{
    pthread_attr_t how;
    pthread_t thread;
    int i = 0;

    memset(stack, 0xA5, SIZE);
    pthread_attr_init(&how);
    pthread_attr_setstack(&how, stack, SIZE);
    pthread_create(&thread, &how, run, NULL);
    pthread_join(thread, NULL);
    while (i < SIZE && stack[i] == 0xA5)
        i++;
    return SIZE - i;
}

int main(void)
{
    used(rows), used(torque); /* binds the functions of the C library */
    printf("%d %d %d", used(nothing), used(torque), used(rows));
    return 0;
}
