#include <stdio.h>
#include "demo_arm_joints.h"
#include "demo_arm_generator.h"

int main(void)
{
    for (int i = 0; i < DEMO_ARM_JOINTS; i++) {
        const demo_arm_joint *const joint = &demo_arm_joints[i];

        printf("%s|%s|%s|%d|%.17g|%.17g|%.17g|%.17g\n", joint->name, joint->unit,
               joint->effort_unit, joint->actuated, joint->lower, joint->upper, joint->speed,
               joint->acceleration);
    }
    printf("%d|%s|%s|%08x%08x|%s\n", DEMO_ARM_INTERFACE, DEMO_ARM_LICENSE, DEMO_ARM_GENERATOR,
           DEMO_ARM_SIGNATURE_1, DEMO_ARM_SIGNATURE_2, DEMO_ARM_SIGNATURE);
    return 0;
}
