/* What is known of the posture to which loops were closed last; the same in both precisions. */
#ifndef MODELER_KEPT_H
#define MODELER_KEPT_H

typedef struct {
    int valid;    /* there is one */
    int at;       /* which of two places holds its values and factors */
    int bent;     /* the step that led there may tell how the next one bends */
    int coupled;  /* G is at hand */
    int reached;  /* a posture was closed before, if none is valid now */
    int dense[2]; /* factors of each place: rows were exchanged */
} modeler_kept;

#endif
