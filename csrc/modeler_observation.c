/* The observation matrix of many samples; see modeler_runtime.h. */
#include "modeler_runtime.h"

#include <string.h>

void modeler_observation(modeler_function_3 function, const modeler_pattern *pattern, size_t samples,
                         const double *q, const double *qd, const double *qdd, double *values,
                         int fill_zeros, double *W)
{
    const size_t rows = pattern->rows, columns = pattern->columns;
    const size_t nonzeros = pattern->nonzeros;

    for (size_t i = 0; i < samples; i++) {
        double *block = W + i * rows * columns;

        function(q + i * rows, qd + i * rows, qdd + i * rows, values);
        if (fill_zeros)
            memset(block, 0, rows * columns * sizeof *block); /* all bits 0 is 0.0 in IEEE 754 */
        for (size_t k = 0; k < nonzeros; k++)
            block[(size_t)pattern->row[k] * columns + (size_t)pattern->column[k]] = values[k];
    }
}
