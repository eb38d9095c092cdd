#include <math.h>
#include <stdio.h>

#include "box3d/collision.h"

static b3Quat quat(float w, float x, float y, float z) {
    float length = sqrtf(w * w + x * x + y * y + z * z);
    return (b3Quat){{x / length, y / length, z / length}, w / length};
}

int main(void) {
    /* Two segments of 1 m with a radius of 1 cm. Both turn by 70 to 71 degrees, as the centres change places. */
    b3Vec3 first[] = {{0, 0, 0}, {0, 0, 1}}, second[] = {{0, 0, 0}, {0, -1, 0}};
    b3Sweep a = {{0, 0, 0}, {0, 1, 0}, {0, 0, 0}, quat(1, 0, -1, 1), quat(0, 0, -1, 1)};
    b3Sweep b = {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, quat(1, 0, 0, -1), quat(1, 0, 1, -1)};
    b3ShapeProxy proxies[] = {{first, 2, 0.01f}, {second, 2, 0.01f}};
    b3TOIInput input = {proxies[0], proxies[1], a, b, 1};
    b3TOIOutput output = b3TimeOfImpact(&input);
    printf("b3TimeOfImpact: state %d (%d would be a hit), fraction %g\n", output.state, b3_toiStateHit, output.fraction);
    float times[] = {0, 0.25f, 1.0f / 3, 0.5f, 1};
    for (int i = 0; i < 5; i++) {
        b3Transform place = b3InvMulTransforms(b3GetSweepTransform(&a, times[i]), b3GetSweepTransform(&b, times[i]));
        b3DistanceInput at = {proxies[0], proxies[1], place, true};
        b3SimplexCache cache = {0};
        printf("b3ShapeDistance at %.4f: %.4f\n", times[i], b3ShapeDistance(&at, &cache, NULL, 0).distance);
    }
}
