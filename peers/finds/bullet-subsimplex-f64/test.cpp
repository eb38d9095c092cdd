// c++ -std=c++17 test.cpp $(pkg-config --cflags bullet-float64) -lBulletCollision-float64 -lLinearMath-float64 && ./a.out
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <iostream>

btTransform along(btVector3 a, btVector3 b) {
    return btTransform(shortestArcQuat(btVector3(0, 1, 0), (b - a).normalized()), (a + b) / 2);
}

int main() {
    // Capsules of 0.5 m and 1 m from A to B and from C to D. The step is (-3, -3, 0) of one and (0, 1, 3) of the other.
    btVector3 a(2, 3, 2), b(2, 0, 1), c(3, -2, 1), d(-1, 0, 3);
    btCapsuleShape first(0.5, (b - a).length()), second(1, (d - c).length());
    btTransform from[] = {along(b, a), along(c, d)}, to[] = {from[0], from[1]};
    to[0].getOrigin() += btVector3(-3, -3, 0);
    to[1].getOrigin() += btVector3(0, 1, 3);
    btVoronoiSimplexSolver simplex;
    btSubsimplexConvexCast subsimplex(&first, &second, &simplex);
    btGjkConvexCast gjk(&first, &second, &simplex);
    for (btConvexCast* cast : {(btConvexCast*)&gjk, (btConvexCast*)&subsimplex}) {
        btConvexCast::CastResult result;
        result.m_fraction = 1;
        bool hit = cast->calcTimeOfImpact(from[0], to[0], from[1], to[1], result);
        std::cout << (hit ? "contact" : "no contact") << " at " << result.m_fraction << '\n';
    }
}
