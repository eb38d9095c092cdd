// The convex casts of Bullet as a library that tunnelproof judges. PEERS_METHOD chooses the cast: subsimplex, gjk or
// continuous. The casts are for bodies that are apart: so the closest points are asked for first, and a distance of at most 0
// is a hit at the start. Edges with a radius are capsules or spheres; edges without are not asked, since its shapes are not meant to
// be without a margin. Triangles have a margin of 0, boxes too but for btGjkConvexCast; a box that is turned is the hull of its
// corners. Bodies that turn are asked of btContinuousConvexCollision alone, which turns them at a constant rate; a capsule is then
// the hull of two spheres, as it may lie anywhere in the frame of its body.
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btMultiSphereShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <cstring>
#include <memory>

#include "../common/bodies.h"
#include "../common/timed.h"
#include "tunnelproof_subject.h"

namespace {

struct Body {
    std::unique_ptr<btConvexShape> shape;
    btTransform from, to;
};

btVector3 vector(const double *p) { return btVector3(p[0], p[1], p[2]); }

void place(Body &body, const btQuaternion &rotation, const btVector3 &centre, const double points[24], int first) {
    double step[3];
    peers_step(points, first, step);
    body.from = btTransform(rotation, centre);
    body.to = btTransform(rotation, centre + vector(step));
}

Body capsule(const double points[24], int first, double radius) {
    Body body;
    struct peers_capsule c = peers_capsule(points, first, 1);
    if (c.half == 0)
        body.shape = std::make_unique<btSphereShape>(radius);
    else
        body.shape = std::make_unique<btCapsuleShape>(radius, 2 * c.half);
    const double *r = c.rotation;
    place(body, btQuaternion(r[0], r[1], r[2], r[3]), vector(c.centre), points, first);
    return body;
}

Body sphere(const double points[24], double radius) {
    Body body;
    body.shape = std::make_unique<btSphereShape>(radius);
    place(body, btQuaternion::getIdentity(), vector(points), points, 0);
    return body;
}

// In its own frame, whose origin is a corner.
Body triangle(const double points[24]) {
    Body body;
    btVector3 b = vector(points + 3);
    body.shape = std::make_unique<btTriangleShape>(btVector3(0, 0, 0), vector(points + 6) - b, vector(points + 9) - b);
    body.shape->setMargin(0);
    place(body, btQuaternion::getIdentity(), b, points, 1);
    return body;
}

// btGjkConvexCast has nothing for shapes that touch without their margins: without margins it misses most contacts of boxes.
// So its boxes have the margin that Bullet gives them, a tenth of the least half side, which rounds the corners. A hull with a
// margin would be larger than the box.
bool needs_margin() {
    static const char *method = getenv("PEERS_METHOD");
    return method && !strcmp(method, "gjk");
}

// Of a box along the axes the box, else the hull of the corners, seen from the first.
Body box(const peers_body &from) {
    Body body;
    double centre[3], half[3];
    if (peers_aligned(&from, centre, half)) {
        auto shape = std::make_unique<btBoxShape>(vector(half));
        if (!needs_margin()) {
            shape->setMargin(0);
            // A margin that was taken off and added again is rounded.
            shape->setImplicitShapeDimensions(vector(half));
        }
        body.shape = std::move(shape);
    } else {
        auto hull = std::make_unique<btConvexHullShape>();
        memcpy(centre, from.points, sizeof centre);
        for (int i = 0; i < 8; i++) {
            double corner[3];
            peers_corner(&from, i, corner);
            hull->addPoint(btVector3(corner[0] - centre[0], corner[1] - centre[1], corner[2] - centre[2]), i == 7);
        }
        hull->setMargin(0);
        body.shape = std::move(hull);
    }
    body.from = btTransform(btQuaternion::getIdentity(), vector(centre));
    body.to = btTransform(btQuaternion::getIdentity(), vector(centre) + vector(from.step));
    return body;
}

// A body of a cast of a box.
Body convex(const peers_body &from) {
    double points[24];
    peers_query_points(&from, points);
    switch (from.shape) {
        case TUNNELPROOF_BOX: return box(from);
        case TUNNELPROOF_TRIANGLE: return triangle(points);
        case TUNNELPROOF_SPHERE: return sphere(points, from.radius);
        default: return capsule(points, 0, from.radius);
    }
}

std::unique_ptr<btConvexCast> make_cast(const Body &a, const Body &b, btVoronoiSimplexSolver &simplex,
                                        btGjkEpaPenetrationDepthSolver &depth) {
    static const char *method = getenv("PEERS_METHOD");
    if (method && !strcmp(method, "gjk"))
        return std::make_unique<btGjkConvexCast>(a.shape.get(), b.shape.get(), &simplex);
    if (method && !strcmp(method, "continuous"))
        return std::make_unique<btContinuousConvexCollision>(a.shape.get(), b.shape.get(), &simplex, &depth);
    return std::make_unique<btSubsimplexConvexCast>(a.shape.get(), b.shape.get(), &simplex);
}

bool touches(const Body &a, const Body &b, btVoronoiSimplexSolver &simplex, btGjkEpaPenetrationDepthSolver &depth) {
    btGjkPairDetector detector(a.shape.get(), b.shape.get(), &simplex, &depth);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = a.from;
    input.m_transformB = b.from;
    btPointCollector closest;
    detector.getClosestPoints(input, closest, nullptr);
    return closest.m_hasResult && closest.m_distance <= 0;
}

int cast(const Body &a, const Body &b, double *toi) {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    std::unique_ptr<btConvexCast> caster = make_cast(a, b, simplex, depth);
    btConvexCast::CastResult result;
    result.m_fraction = 1;
    uint64_t start = peers_now();
    bool at_start = touches(a, b, simplex, depth);
    bool hit = at_start || caster->calcTimeOfImpact(a.from, a.to, b.from, b.to, result);
    peers_took(start);
    *toi = at_start ? 0 : result.m_fraction;
    return hit ? TUNNELPROOF_HIT : TUNNELPROOF_MISS;
}

}  // namespace

int tunnelproof_edge_edge(const double points[24], const double radius[2], double *toi) {
    if (radius[0] <= 0 || radius[1] <= 0) return TUNNELPROOF_UNSUPPORTED;
    return cast(capsule(points, 0, radius[0] + peers_skin()), capsule(points, 2, radius[1]), toi);
}

int tunnelproof_vertex_face(const double points[24], const double radius[2], double *toi) {
    double both = radius[0] + radius[1];
    if (both <= 0) return TUNNELPROOF_UNSUPPORTED;
    return cast(sphere(points, both + peers_skin()), triangle(points), toi);
}

int tunnelproof_box_cast(const int shapes[2], const double bodies[30], const double radius[2], double *toi) {
    peers_body both[2];
    peers_bodies(shapes, bodies, radius, both);
    for (const peers_body &body : both) {
        double centre[3], half[3];
        bool is_turned = body.shape == TUNNELPROOF_BOX && !peers_aligned(&body, centre, half);
        if (is_turned && needs_margin()) return TUNNELPROOF_UNSUPPORTED;
        if (body.shape <= TUNNELPROOF_SEGMENT && body.radius <= 0) return TUNNELPROOF_UNSUPPORTED;
    }
    return cast(convex(both[0]), convex(both[1]), toi);
}

namespace {

Body turning(const struct peers_turning &from) {
    Body body;
    btVector3 points[3];
    for (int i = 0; i < from.count; i++) points[i] = vector(from.local + 3 * i);
    if (from.count == 3) {
        body.shape = std::make_unique<btTriangleShape>(points[0], points[1], points[2]);
        body.shape->setMargin(0);
    } else {
        btScalar radii[] = {btScalar(from.radius), btScalar(from.radius)};
        body.shape = std::make_unique<btMultiSphereShape>(points, radii, from.count);
        // What is within the margin are the points: a margin above the radius would turn the spheres inside out.
        body.shape->setMargin(radii[0]);
    }
    auto pose = [&from](int end) {
        const double *q = from.quaternions[end];
        return btTransform(btQuaternion(q[0], q[1], q[2], q[3]), vector(from.centres[end]));
    };
    body.from = pose(0);
    body.to = pose(1);
    return body;
}

// The engine turns a body by 45 degrees in a call at most (ANGULAR_MOTION_THRESHOLD): what turns farther would make another motion.
bool turns_too_far(const struct peers_turning &body) {
    double along = 0;
    for (int k = 0; k < 4; k++) along += body.quaternions[0][k] * body.quaternions[1][k];
    return 2 * acos(fmin(along, 1)) > 0.7854;
}

int turning_cast(const double local[12], const double poses[28], int count, const double radius[2], double *toi) {
    static const char *method = getenv("PEERS_METHOD");
    if (!method || strcmp(method, "continuous") || radius[0] <= 0 || (count == 2 && radius[1] <= 0))
        return TUNNELPROOF_UNSUPPORTED;
    struct peers_turning both[2];
    peers_turning(local, poses, count, radius, both);
    if (turns_too_far(both[0]) || turns_too_far(both[1])) return TUNNELPROOF_UNSUPPORTED;
    return cast(turning(both[0]), turning(both[1]), toi);
}

}  // namespace

int tunnelproof_turning_edge_turning_edge(const double local[12], const double poses[28], const double radius[2],
                                          double *toi) {
    return turning_cast(local, poses, 2, radius, toi);
}

int tunnelproof_turning_vertex_turning_face(const double local[12], const double poses[28], const double radius[2],
                                            double *toi) {
    return turning_cast(local, poses, 1, radius, toi);
}
