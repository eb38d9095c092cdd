// Continuous collision of FCL as a library that tunnelproof judges. PEERS_METHOD chooses the solver: naive, with all
// settings as the library has them, or conservative-advancement. Edges with a radius are capsules or spheres, a face is a
// mesh of one triangle, a box that is turned the hull of its corners. Bodies that turn do so at a constant rate about their centre,
// fcl::InterpMotion.
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

// Of a box along the axes the box, else the hull of the corners, seen from the first, with its faces outwards.
Body box(const peers_body &from) {
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    Body body;
    double centre[3], half[3];
    if (peers_aligned(&from, centre, half)) {
        body.shape = std::make_shared<fcl::Boxd>(2 * half[0], 2 * half[1], 2 * half[2]);
    } else {
        memcpy(centre, from.points, sizeof centre);
        auto corners = std::make_shared<std::vector<Vector>>();
        for (int i = 0; i < 8; i++) {
            double corner[3];
            peers_corner(&from, i, corner);
            corners->push_back(vector(corner) - vector(centre));
        }
        bool is_right = (*corners)[1].cross((*corners)[2]).dot((*corners)[4]) > 0;
        auto list = std::make_shared<std::vector<int>>();
        for (const int *face : faces) {
            list->push_back(4);
            for (int i = 0; i < 4; i++) list->push_back(face[is_right ? i : 3 - i]);
        }
        body.shape = std::make_shared<fcl::Convexd>(corners, 6, list);
    }
    body.shape->computeLocalAABB();
    body.from.translation() = vector(centre);
    body.to.translation() = vector(centre) + vector(from.step);
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

int tunnelproof_box_cast(const int shapes[2], const double bodies[30], const double radius[2], double *toi) {
    peers_body both[2];
    peers_bodies(shapes, bodies, radius, both);
    for (const peers_body &body : both)
        if (body.shape <= TUNNELPROOF_SEGMENT && body.radius <= 0) return TUNNELPROOF_UNSUPPORTED;
    return cast(convex(both[0]), convex(both[1]), toi);
}

namespace {

using Motion = fcl::InterpMotion<double>;

struct Turning {
    std::shared_ptr<fcl::CollisionGeometryd> shape;
    std::shared_ptr<Motion> motion;
};

// A capsule has its middle in the origin of its frame, which is turned about the centre of the body.
Turning turning(const struct peers_turning &from) {
    Body body;
    Vector middle = Vector::Zero();
    fcl::Quaterniond along = fcl::Quaterniond::Identity();
    if (from.count == 3) {
        double points[24] = {0};
        memcpy(points + 3, from.local, 9 * sizeof(double));
        body = triangle(points);
        middle = vector(from.local);
    } else {
        double points[24] = {0};
        for (int i = 0; i < 2; i++) memcpy(points + 3 * i, from.local + 3 * (i % from.count), 3 * sizeof(double));
        body = capsule(points, 0, from.radius);
        middle = body.from.translation();
        along = fcl::Quaterniond(body.from.linear());
    }
    fcl::Matrix3d rotation[2];
    Vector place[2];
    for (int end = 0; end < 2; end++) {
        const double *q = from.quaternions[end];
        fcl::Quaterniond turn(q[3], q[0], q[1], q[2]);
        rotation[end] = (turn * along).toRotationMatrix();
        place[end] = vector(from.centres[end]) + turn * middle;
    }
    Vector centre = along.conjugate() * -middle;
    return {body.shape, std::make_shared<Motion>(rotation[0], place[0], rotation[1], place[1], centre)};
}

int turning_cast(const double local[12], const double poses[28], int count, const double radius[2], double *toi) {
    static const fcl::ContinuousCollisionRequestd asked = [] {
        fcl::ContinuousCollisionRequestd asked = request();
        asked.ccd_motion_type = fcl::CCDM_LINEAR;
        return asked;
    }();
    if (radius[0] <= 0 || (count == 2 && radius[1] <= 0)) return TUNNELPROOF_UNSUPPORTED;
    struct peers_turning both[2];
    peers_turning(local, poses, count, radius, both);
    Turning a = turning(both[0]), b = turning(both[1]);
    fcl::ContinuousCollisionResultd result;
    uint64_t start = peers_now();
    fcl::continuousCollide<double>(a.shape.get(), a.motion.get(), b.shape.get(), b.motion.get(), asked, result);
    peers_took(start);
    *toi = result.time_of_contact;
    return result.is_collide ? TUNNELPROOF_HIT : TUNNELPROOF_MISS;
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
