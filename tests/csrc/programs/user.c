#include "PREFIX.h"
#include <stdio.h>
#include <string.h>

int main(void)
{
    const int same = strcmp(PREFIX_signature(), MACRO_SIGNATURE) == 0;
    printf("%d %d", MACRO_JOINTS, same);
    return !same;
}
