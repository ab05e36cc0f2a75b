/* Emitted functions over many samples; see modeler_batch.h. */
#include "modeler_batch.h"

/* Values of input `which` at sample i. */
#define AT(which) (inputs[which].data + i * inputs[which].step)

void modeler_batch_1(modeler_function_1 function, size_t samples, const modeler_input inputs[1],
                     modeler_real *out, size_t out_step)
{
    for (size_t i = 0; i < samples; i++) {
        function(AT(0), out + i * out_step);
    }
}

void modeler_batch_2(modeler_function_2 function, size_t samples, const modeler_input inputs[2],
                     modeler_real *out, size_t out_step)
{
    for (size_t i = 0; i < samples; i++) {
        function(AT(0), AT(1), out + i * out_step);
    }
}

void modeler_batch_3(modeler_function_3 function, size_t samples, const modeler_input inputs[3],
                     modeler_real *out, size_t out_step)
{
    for (size_t i = 0; i < samples; i++) {
        function(AT(0), AT(1), AT(2), out + i * out_step);
    }
}

void modeler_batch_4(modeler_function_4 function, size_t samples, const modeler_input inputs[4],
                     modeler_real *out, size_t out_step)
{
    for (size_t i = 0; i < samples; i++) {
        function(AT(0), AT(1), AT(2), AT(3), out + i * out_step);
    }
}

void modeler_batch_5(modeler_function_5 function, size_t samples, const modeler_input inputs[5],
                     modeler_real *out, size_t out_step)
{
    for (size_t i = 0; i < samples; i++) {
        function(AT(0), AT(1), AT(2), AT(3), AT(4), out + i * out_step);
    }
}

void modeler_batch_6(modeler_function_6 function, size_t samples, const modeler_input inputs[6],
                     modeler_real *out, size_t out_step)
{
    for (size_t i = 0; i < samples; i++) {
        function(AT(0), AT(1), AT(2), AT(3), AT(4), AT(5), out + i * out_step);
    }
}

void modeler_batch_status_1(modeler_status_1 function, size_t samples,
                            const modeler_input inputs[1], modeler_real *out, size_t out_step,
                            int *status)
{
    for (size_t i = 0; i < samples; i++) {
        status[i] = function(AT(0), out + i * out_step);
    }
}

void modeler_batch_status_2(modeler_status_2 function, size_t samples,
                            const modeler_input inputs[2], modeler_real *out, size_t out_step,
                            int *status)
{
    for (size_t i = 0; i < samples; i++) {
        status[i] = function(AT(0), AT(1), out + i * out_step);
    }
}

void modeler_batch_status_3(modeler_status_3 function, size_t samples,
                            const modeler_input inputs[3], modeler_real *out, size_t out_step,
                            int *status)
{
    for (size_t i = 0; i < samples; i++) {
        status[i] = function(AT(0), AT(1), AT(2), out + i * out_step);
    }
}

void modeler_batch_status_4(modeler_status_4 function, size_t samples,
                            const modeler_input inputs[4], modeler_real *out, size_t out_step,
                            int *status)
{
    for (size_t i = 0; i < samples; i++) {
        status[i] = function(AT(0), AT(1), AT(2), AT(3), out + i * out_step);
    }
}

void modeler_batch_status_5(modeler_status_5 function, size_t samples,
                            const modeler_input inputs[5], modeler_real *out, size_t out_step,
                            int *status)
{
    for (size_t i = 0; i < samples; i++) {
        status[i] = function(AT(0), AT(1), AT(2), AT(3), AT(4), out + i * out_step);
    }
}
