/* Seals, checks and publishes sets of a two-link arm, and reads them in another thread. */
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include "two_link_control.h"

static two_link_store store;
static int over;

/* A cycle: all of one set, or none. */
static void *reader(void *counted)
{
    int cycles = 0;
    while (!__atomic_load_n(&over, __ATOMIC_ACQUIRE)) {
        const two_link_set *const set = two_link_set_current(&store);
        if (set != NULL) {
            const double first = set->beta[0];
            for (int i = 0; i < TWO_LINK_BASE_PARAMETERS; i++)
                if (set->beta[i] < first || set->beta[i] > first)
                    return NULL;
            cycles++;
        }
    }
    *(int *)counted = cycles;
    return NULL;
}

int main(void)
{
    two_link_set set, other;
    pthread_t thread;
    int cycles = 0, published = 0;

    memset(&set, 0, sizeof(set));
    if (two_link_set_current(&store) != NULL ||
        two_link_set_publish(&store, &set) != MODELER_FOREIGN)
        return 1;
    for (int i = 0; i < TWO_LINK_BASE_PARAMETERS; i++)
        set.beta[i] = 0.5 + i;
    for (size_t i = 0; i < sizeof(set.widths) / sizeof(*set.widths); i++)
        set.widths[i] = 0.01;
    two_link_set_seal(&set);
    printf("%lu %u", (unsigned long)set.checksum, (unsigned)(sizeof(set.widths) / sizeof(double)));
    if (two_link_set_check(&set) != MODELER_DONE)
        return 2;
    for (size_t byte = 0; byte < offsetof(two_link_set, checksum); byte++) {
        other = set;
        ((unsigned char *)&other)[byte] ^= 4;
        if (two_link_set_check(&other) != MODELER_FOREIGN)
            return 3;
    }
    other = set;
    other.beta[1] = 1e300 * 1e300;
    two_link_set_seal(&other);
    if (two_link_set_check(&other) != MODELER_NOT_FINITE)
        return 4;
    if (two_link_set_publish(&store, &set) != MODELER_DONE)
        return 5;
    if (two_link_set_publish(&store, &set) != MODELER_UNFINISHED) /* nobody has taken it */
        return 6;
    if (two_link_set_publish(&store, &other) != MODELER_NOT_FINITE)
        return 7;
    if (memcmp(two_link_set_current(&store), &set, sizeof(set)) != 0)
        return 8;
    for (int i = 0; i < TWO_LINK_BASE_PARAMETERS; i++)
        set.beta[i] = 0.0;
    two_link_set_seal(&set);
    while (two_link_set_publish(&store, &set) != MODELER_DONE ||
           two_link_set_current(&store) == NULL)
        ;
    if (pthread_create(&thread, NULL, reader, &cycles) != 0)
        return 9;
    while (published < 100) {
        for (int i = 0; i < TWO_LINK_BASE_PARAMETERS; i++)
            set.beta[i] = published;
        two_link_set_seal(&set);
        published += two_link_set_publish(&store, &set) == MODELER_DONE;
    }
    __atomic_store_n(&over, 1, __ATOMIC_RELEASE);
    pthread_join(thread, NULL);
    return cycles > 0 ? 0 : 10;
}
