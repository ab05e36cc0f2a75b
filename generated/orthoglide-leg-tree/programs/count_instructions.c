/* One leg of the Orthoglide, cut open
 *
 * Counts the instructions of one call of every function on a Cortex-M4 or M7, in qemu, and prints
 * them as a header: the most of 16 states. The code has no branches but signs, so further
 * states differ by a few instructions at most.
 * `make count` compiles and runs it; it is no part of the library.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#if !defined(__arm__) || !defined(__GNUC__)
int main(void)
{
    return 2; /* it runs on a Cortex-M alone */
}
#else
#include <stddef.h>
#include <stdint.h>

#include "modeler_batch.h"
#include "orthoglide_leg_tree.h"

#define N ORTHOGLIDE_LEG_TREE_JOINTS
#define STATES 16
#define REPEAT 400    /* calls of one count */
#define PER_TICK 40   /* instructions: 1 ns each, and the timer has 25 MHz */
#define LARGEST 360

int main(void);

static double q[N], qd[N], qdd[N], v[N], a[N], dq[N], dt[1];
static double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS];
static double chi[ORTHOGLIDE_LEG_TREE_STANDARD_PARAMETERS], out[LARGEST];

/* The debugger's service `what` of the machine. */
static int service(int what, const void *with)
{
    register int r0 __asm__("r0") = what;
    register const void *r1 __asm__("r1") = with;

    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

static void say(const char *text)
{
    service(4, text);
}

static void say_number(unsigned long number)
{
    char text[16];
    int at = 15;

    text[15] = '\0';
    do {
        text[--at] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    say(text + at);
}

/* The machine: where it starts, and its timer, which counts down. */
static void start(void)
{
    *(volatile uint32_t *)0xE000ED88u |= 0xFu << 20; /* floating point on */
    __asm__ volatile("dsb\n\tisb");
    ((volatile uint32_t *)0xE000E010u)[1] = 0xFFFFFFu;
    ((volatile uint32_t *)0xE000E010u)[2] = 0;
    ((volatile uint32_t *)0xE000E010u)[0] = 5;
    main();
    service(0x18, (const void *)0x20026);
}

static const uintptr_t vectors[2] __attribute__((section(".vectors"), used)) = {
    0x20400000u, (uintptr_t)start
};

static uint32_t now(void)
{
    return ((volatile uint32_t *)0xE000E010u)[2];
}

/* Functions of one instruction, which the loop around a call is counted with. */
__attribute__((noinline))
static void nothing_1(const double *a1, double *b)
{
    (void)a1;
    (void)b;
    __asm__ volatile("" : : : "memory");
}
__attribute__((noinline))
static void nothing_2(const double *a1, const double *a2, double *b)
{
    (void)a1;
    (void)a2;
    (void)b;
    __asm__ volatile("" : : : "memory");
}
__attribute__((noinline))
static void nothing_3(const double *a1, const double *a2, const double *a3,
        double *b)
{
    (void)a1;
    (void)a2;
    (void)a3;
    (void)b;
    __asm__ volatile("" : : : "memory");
}
__attribute__((noinline))
static void nothing_4(const double *a1, const double *a2, const double *a3,
        const double *a4, double *b)
{
    (void)a1;
    (void)a2;
    (void)a3;
    (void)a4;
    (void)b;
    __asm__ volatile("" : : : "memory");
}

static void prepare(int state)
{
    for (int i = 0; i < N; i++) {
        const int sign = ((state >> (i % 4)) & 1) ? 1 : -1;

        q[i] = 0.1 * (double)(sign * (7 * state + 3 * i + 1));
        qd[i] = 0.3 * (double)(sign * (i + 1 + state));
        qdd[i] = 0.7 * (double)(state - i);
        v[i] = 0.4 * (double)(sign * (state - i));
        a[i] = 0.2 * (double)(state + i);
        dq[i] = 0.01 * (double)(sign * i);
    }
    dt[0] = 0.001;
    for (int k = 0; k < ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS; k++) {
        beta[k] = 1.0 + 0.1 * (double)k;
    }
    for (int k = 0; k < ORTHOGLIDE_LEG_TREE_STANDARD_PARAMETERS; k++) {
        chi[k] = 1.0 + 0.1 * (double)k;
    }
}

/* Ticks of `before` to `after`, less those of the loop, as instructions of one call. */
static void keep(unsigned long *most, uint32_t before, uint32_t between, uint32_t after)
{
    const uint32_t whole = (before - between) & 0xFFFFFFu, loop = (between - after) & 0xFFFFFFu;
    const unsigned long all = (unsigned long)(whole - loop) * PER_TICK;
    const unsigned long found = 1 + (all + REPEAT / 2) / REPEAT;

    if (found > *most) {
        *most = found;
    }
}

static unsigned long count_regressor(void)
{
    static const modeler_input inputs[3] = {
        {q, 0},
        {qd, 0},
        {qdd, 0},
    };
    unsigned long most = 0;

    for (int state = 0; state < STATES; state++) {
        uint32_t before, between;

        prepare(state);
        before = now();
        modeler_batch_3(orthoglide_leg_tree_regressor, REPEAT, inputs, out, 0);
        between = now();
        modeler_batch_3(nothing_3, REPEAT, inputs, out, 0);
        keep(&most, before, between, now());
    }
    return most;
}

static unsigned long count_base_regressor(void)
{
    static const modeler_input inputs[3] = {
        {q, 0},
        {qd, 0},
        {qdd, 0},
    };
    unsigned long most = 0;

    for (int state = 0; state < STATES; state++) {
        uint32_t before, between;

        prepare(state);
        before = now();
        modeler_batch_3(orthoglide_leg_tree_base_regressor, REPEAT, inputs, out, 0);
        between = now();
        modeler_batch_3(nothing_3, REPEAT, inputs, out, 0);
        keep(&most, before, between, now());
    }
    return most;
}

static unsigned long count_base_regressor_nonzeros(void)
{
    static const modeler_input inputs[3] = {
        {q, 0},
        {qd, 0},
        {qdd, 0},
    };
    unsigned long most = 0;

    for (int state = 0; state < STATES; state++) {
        uint32_t before, between;

        prepare(state);
        before = now();
        modeler_batch_3(orthoglide_leg_tree_base_regressor_nonzeros, REPEAT, inputs, out, 0);
        between = now();
        modeler_batch_3(nothing_3, REPEAT, inputs, out, 0);
        keep(&most, before, between, now());
    }
    return most;
}

static unsigned long count_inverse_dynamics(void)
{
    static const modeler_input inputs[4] = {
        {q, 0},
        {qd, 0},
        {qdd, 0},
        {beta, 0},
    };
    unsigned long most = 0;

    for (int state = 0; state < STATES; state++) {
        uint32_t before, between;

        prepare(state);
        before = now();
        modeler_batch_4(orthoglide_leg_tree_inverse_dynamics, REPEAT, inputs, out, 0);
        between = now();
        modeler_batch_4(nothing_4, REPEAT, inputs, out, 0);
        keep(&most, before, between, now());
    }
    return most;
}

static unsigned long count_inertia_matrix(void)
{
    static const modeler_input inputs[2] = {
        {q, 0},
        {beta, 0},
    };
    unsigned long most = 0;

    for (int state = 0; state < STATES; state++) {
        uint32_t before, between;

        prepare(state);
        before = now();
        modeler_batch_2(orthoglide_leg_tree_inertia_matrix, REPEAT, inputs, out, 0);
        between = now();
        modeler_batch_2(nothing_2, REPEAT, inputs, out, 0);
        keep(&most, before, between, now());
    }
    return most;
}

static unsigned long count_gravity(void)
{
    static const modeler_input inputs[2] = {
        {q, 0},
        {beta, 0},
    };
    unsigned long most = 0;

    for (int state = 0; state < STATES; state++) {
        uint32_t before, between;

        prepare(state);
        before = now();
        modeler_batch_2(orthoglide_leg_tree_gravity, REPEAT, inputs, out, 0);
        between = now();
        modeler_batch_2(nothing_2, REPEAT, inputs, out, 0);
        keep(&most, before, between, now());
    }
    return most;
}

static unsigned long count_coriolis(void)
{
    static const modeler_input inputs[3] = {
        {q, 0},
        {qd, 0},
        {beta, 0},
    };
    unsigned long most = 0;

    for (int state = 0; state < STATES; state++) {
        uint32_t before, between;

        prepare(state);
        before = now();
        modeler_batch_3(orthoglide_leg_tree_coriolis, REPEAT, inputs, out, 0);
        between = now();
        modeler_batch_3(nothing_3, REPEAT, inputs, out, 0);
        keep(&most, before, between, now());
    }
    return most;
}

static unsigned long count_friction(void)
{
    static const modeler_input inputs[2] = {
        {qd, 0},
        {beta, 0},
    };
    unsigned long most = 0;

    for (int state = 0; state < STATES; state++) {
        uint32_t before, between;

        prepare(state);
        before = now();
        modeler_batch_2(orthoglide_leg_tree_friction, REPEAT, inputs, out, 0);
        between = now();
        modeler_batch_2(nothing_2, REPEAT, inputs, out, 0);
        keep(&most, before, between, now());
    }
    return most;
}

static unsigned long count_base_parameters(void)
{
    static const modeler_input inputs[1] = {
        {chi, 0},
    };
    unsigned long most = 0;

    for (int state = 0; state < STATES; state++) {
        uint32_t before, between;

        prepare(state);
        before = now();
        modeler_batch_1(orthoglide_leg_tree_base_parameters, REPEAT, inputs, out, 0);
        between = now();
        modeler_batch_1(nothing_1, REPEAT, inputs, out, 0);
        keep(&most, before, between, now());
    }
    return most;
}

static unsigned long count_forward_kinematics(void)
{
    static const modeler_input inputs[1] = {
        {q, 0},
    };
    unsigned long most = 0;

    for (int state = 0; state < STATES; state++) {
        uint32_t before, between;

        prepare(state);
        before = now();
        modeler_batch_1(orthoglide_leg_tree_forward_kinematics, REPEAT, inputs, out, 0);
        between = now();
        modeler_batch_1(nothing_1, REPEAT, inputs, out, 0);
        keep(&most, before, between, now());
    }
    return most;
}

int main(void)
{
    say("/* Instructions of one call at most, counted in qemu:\n");
    say(" * orthoglide_leg_tree 3decae1a5d54f2a6. */\n");
    say("#define ORTHOGLIDE_LEG_TREE_REGRESSOR_INSTRUCTIONS ");
    say_number(count_regressor());
    say("\n");
    say("#define ORTHOGLIDE_LEG_TREE_BASE_REGRESSOR_INSTRUCTIONS ");
    say_number(count_base_regressor());
    say("\n");
    say("#define ORTHOGLIDE_LEG_TREE_BASE_REGRESSOR_NONZEROS_INSTRUCTIONS ");
    say_number(count_base_regressor_nonzeros());
    say("\n");
    say("#define ORTHOGLIDE_LEG_TREE_INVERSE_DYNAMICS_INSTRUCTIONS ");
    say_number(count_inverse_dynamics());
    say("\n");
    say("#define ORTHOGLIDE_LEG_TREE_INERTIA_MATRIX_INSTRUCTIONS ");
    say_number(count_inertia_matrix());
    say("\n");
    say("#define ORTHOGLIDE_LEG_TREE_GRAVITY_INSTRUCTIONS ");
    say_number(count_gravity());
    say("\n");
    say("#define ORTHOGLIDE_LEG_TREE_CORIOLIS_INSTRUCTIONS ");
    say_number(count_coriolis());
    say("\n");
    say("#define ORTHOGLIDE_LEG_TREE_FRICTION_INSTRUCTIONS ");
    say_number(count_friction());
    say("\n");
    say("#define ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS_INSTRUCTIONS ");
    say_number(count_base_parameters());
    say("\n");
    say("#define ORTHOGLIDE_LEG_TREE_FORWARD_KINEMATICS_INSTRUCTIONS ");
    say_number(count_forward_kinematics());
    say("\n");
    return 0;
}
#endif
