#include <fcl/math/motion/interp_motion.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <new>

using Motion = fcl::InterpMotion<double>;

static void end(const char *name, const Motion &motion) {
    motion.integrate(1);
    fcl::Transform3d at;
    motion.getCurrentTransform(at);
    std::cout << name << ": " << at.translation().transpose() << "\n";
}

int main() {
    /* A quarter of a turn about z, and one metre along x. */
    fcl::Transform3d from = fcl::Transform3d::Identity(), to = fcl::Transform3d::Identity();
    to.linear() = fcl::AngleAxisd(std::acos(0.0), fcl::Vector3d::UnitZ()).toRotationMatrix();
    to.translation() = fcl::Vector3d(1, 0, 0);
    fcl::Vector3d origin(0, 0, 0);

    /* In memory that holds other numbers, as that of a program does. */
    alignas(Motion) static double memory[2][sizeof(Motion) / sizeof(double)];
    std::fill_n(&memory[0][0], 2 * sizeof(Motion) / sizeof(double), 7.0);
    end("InterpMotion(R1, T1, R2, T2, O)", Motion(from.linear(), from.translation(), to.linear(), to.translation(), origin));
    end("InterpMotion(tf1, tf2, O)", *new (memory[0]) Motion(from, to, origin));
    std::cout << "reference point of InterpMotion(tf1, tf2): " << (new (memory[1]) Motion(from, to))->getReferencePoint().transpose() << "\n";
}
