// Continuous collision of FCL as a library that tunnelproof judges. PEERS_METHOD chooses the solver: naive, with all
// settings as the library has them, or conservative-advancement. Edges with a radius are capsules or spheres, a face is a
// mesh of one triangle.
#include <fcl/fcl.h>

#include <cstring>
#include <memory>
#include <vector>

#include "../common/bodies.h"
#include "../common/timed.h"
#include "tunnelproof_subject.h"

namespace {

using Vector = fcl::Vector3d;
using Transform = fcl::Transform3d;
using Mesh = fcl::BVHModel<fcl::OBBRSSd>;

struct Body {
    std::shared_ptr<fcl::CollisionGeometryd> shape;
    Transform from = Transform::Identity(), to = Transform::Identity();
};

Vector vector(const double *p) { return Vector(p[0], p[1], p[2]); }

void place(Body &body, const fcl::Quaterniond &rotation, const Vector &centre, const double points[24], int first) {
    double step[3];
    peers_step(points, first, step);
    body.from.linear() = body.to.linear() = rotation.toRotationMatrix();
    body.from.translation() = centre;
    body.to.translation() = centre + vector(step);
}

Body capsule(const double points[24], int first, double radius) {
    Body body;
    struct peers_capsule c = peers_capsule(points, first, 2);
    if (c.half == 0)
        body.shape = std::make_shared<fcl::Sphered>(radius);
    else
        body.shape = std::make_shared<fcl::Capsuled>(radius, 2 * c.half);
    const double *r = c.rotation;
    place(body, fcl::Quaterniond(r[3], r[0], r[1], r[2]), vector(c.centre), points, first);
    body.shape->computeLocalAABB();
    return body;
}

Body sphere(const double points[24], double radius) {
    Body body;
    body.shape = std::make_shared<fcl::Sphered>(radius);
    body.shape->computeLocalAABB();
    place(body, fcl::Quaterniond::Identity(), vector(points), points, 0);
    return body;
}

Body triangle(const double points[24]) {
    Body body;
    Vector b = vector(points + 3);
    auto mesh = std::make_shared<Mesh>();
    mesh->beginModel(1, 3);
    mesh->addTriangle(Vector::Zero(), vector(points + 6) - b, vector(points + 9) - b);
    mesh->endModel();
    mesh->computeLocalAABB();
    body.shape = mesh;
    place(body, fcl::Quaterniond::Identity(), b, points, 1);
    return body;
}

fcl::ContinuousCollisionRequestd request() {
    fcl::ContinuousCollisionRequestd request;
    const char *method = getenv("PEERS_METHOD");
    if (method && !strcmp(method, "conservative-advancement"))
        request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
    return request;
}

int cast(const Body &a, const Body &b, double *toi) {
    static const fcl::ContinuousCollisionRequestd asked = request();
    fcl::ContinuousCollisionResultd result;
    uint64_t start = peers_now();
    fcl::continuousCollide(a.shape.get(), a.from, a.to, b.shape.get(), b.from, b.to, asked, result);
    peers_took(start);
    *toi = result.time_of_contact;
    return result.is_collide ? TUNNELPROOF_HIT : TUNNELPROOF_MISS;
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
