// Bodies that Bullet integrates in samara's water: a single one, beside samara's own flight of it, two on a
// hinge, one lighter than water, and discs that sink and lie down on a floor.
//
//   c++ bullet_fall.cpp $(pkg-config --cflags --libs samara bullet) -o bullet-fall
//   ./bullet-fall ellipsoid.body.h5 disc.body.h5
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include <btBulletDynamicsCommon.h>
#include <samara_bullet.hpp>

#include "water.h"

namespace {

btVector3 vector_of(const double* numbers) {
    return {btScalar(numbers[0]), btScalar(numbers[1]), btScalar(numbers[2])};
}

// A world with the bodies of a simulation in it.
struct Host {
    Host(samara_simulation* water, double step) : simulation(water), fluid(world, water, step) {
        world.setGravity({0, 0, btScalar(-9.81)});
    }
    Host(const Host&) = delete;
    ~Host() {
        if (hinge) world.removeConstraint(hinge.get());
        for (const auto& rigid : bodies) world.removeRigidBody(rigid.get());
        samara_simulation_free(simulation);
    }

    // Adds the simulation's next body, at a place of the shape's origin.
    btRigidBody& add(btCollisionShape& shape, const btTransform& place) {
        samara_mass_properties own;
        check(samara_get_mass_properties(simulation, bodies.size(), &own, error, sizeof error));
        auto rigid = std::make_unique<btRigidBody>(btScalar(own.mass), nullptr, &shape);
        rigid->setWorldTransform(place *
                                 btTransform(btQuaternion::getIdentity(), vector_of(own.center_of_mass)));
        world.addRigidBody(rigid.get());
        fluid.add(*rigid, bodies.size());
        bodies.push_back(std::move(rigid));
        return *bodies.back();
    }

    samara_simulation* simulation;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    samara::BulletFluid fluid;
    btEmptyShape none;
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    std::unique_ptr<btHingeConstraint> hinge;
};

// Links above each other; the second on a hinge along x, halfway between their origins.
std::unique_ptr<Host> links(const samara_body* body, double step, int turbulent,
                            const std::vector<double>& densities, double gap) {
    auto host =
        std::make_unique<Host>(water(body, step, turbulent, densities.data(), int(densities.size())), step);
    samara_pose start;
    check(samara_get_poses(host->simulation, 0, 1, &start, 0, error, sizeof error));
    const btVector3 axis = vector_of(start.orientation + 1);
    const btTransform place(btQuaternion(axis.x(), axis.y(), axis.z(), btScalar(start.orientation[0])));
    for (std::size_t i = 0; i < densities.size(); ++i) {
        host->add(host->none,
                  place * btTransform(btQuaternion::getIdentity(), {0, 0, btScalar(gap * double(i))}));
    }
    if (densities.size() > 1) {
        const btVector3 half(0, 0, btScalar(0.5 * gap));
        btRigidBody& low = *host->bodies[0];
        btRigidBody& high = *host->bodies[1];
        const auto from_center = [&](const btRigidBody& link, const btVector3& point) {
            return link.getWorldTransform().inverse() * (place * point);
        };
        host->hinge =
            std::make_unique<btHingeConstraint>(low, high, from_center(low, half), from_center(high, half),
                                                btVector3(1, 0, 0), btVector3(1, 0, 0));
        host->world.addConstraint(host->hinge.get(), true);
    }
    return host;
}

double difference(const samara_body* body, double step) {
    const std::unique_ptr<Host> host = links(body, step, 0, {1200.0}, 0.0);
    const long steps = std::lround(1.0 / step);
    for (long i = 0; i < steps; ++i) host->fluid.step();
    return off_from_own_flight(body, step, 1200.0, double(steps) * step, host->fluid.pose(0).position);
}

void swing_on_a_hinge(const samara_body* body) {
    std::printf("Two on a hinge, 1500 and 900 kg/m^3, with turbulence:\n");
    const std::unique_ptr<Host> pair = links(body, 0.002, 1, {1500.0, 900.0}, 0.1);
    for (int i = 1; i <= 2500; ++i) {
        pair->fluid.step();
        if (i % 500 != 0) continue;
        const btTransform one = pair->bodies[0]->getWorldTransform() * pair->hinge->getAFrame();
        const btTransform two = pair->bodies[1]->getWorldTransform() * pair->hinge->getBFrame();
        std::printf("  %3.1f s  heights %7.3f %7.3f m  hinge %7.1f degrees, open by %6.4f mm\n", i * 0.002,
                    pair->fluid.pose(0).position[2], pair->fluid.pose(1).position[2],
                    pair->hinge->getHingeAngle() * 57.29578,
                    (one.getOrigin() - two.getOrigin()).length() * 1000.0);
    }
}

// Discs of aluminium, 40 mm across, sink from 0.2 m onto a floor.
void lie_down(const samara_body* disc) {
    const std::vector<double> densities(5, 2700.0);
    Host host(water(disc, 0.002, 1, densities.data(), int(densities.size())), 0.002);
    btCylinderShapeZ plate({btScalar(0.02), btScalar(0.02), btScalar(0.001)});
    plate.setMargin(btScalar(0.0002));
    btStaticPlaneShape level({0, 0, 1}, 0);
    btRigidBody floor(0, nullptr, &level);
    host.world.addRigidBody(&floor);
    for (int i = 0; i < 5; ++i) {
        host.add(plate, btTransform(btQuaternion({1, 0, 0}, btScalar(0.2 * i)),
                                    {btScalar(0.1 * i), 0, btScalar(0.2)}));
    }
    std::printf("Discs that sink onto a floor:\n");
    for (int i = 1; i <= 1500; ++i) {
        host.fluid.step();
        if (i % 250 != 0) continue;
        double highest = 0.0, fastest = 0.0, steepest = 0.0;
        for (const auto& body : host.bodies) {
            highest = std::fmax(highest, body->getWorldTransform().getOrigin().z());
            fastest = std::fmax(fastest, body->getLinearVelocity().length());
            steepest = std::fmax(steepest, std::acos(std::fabs(body->getWorldTransform().getBasis()[2][2])));
        }
        std::printf("  %3.1f s  highest %6.2f mm  fastest %6.4f m/s  steepest %5.2f degrees\n", i * 0.002,
                    1000.0 * highest, fastest, steepest * 57.29578);
    }
    host.world.removeRigidBody(&floor);
}

}  // namespace

int main(int count, char** words) try {
    if (count != 3) {
        std::fprintf(stderr, "Usage: bullet-fall ellipsoid.body.h5 disc.body.h5\n");
        return 1;
    }
    samara_body *ellipsoid, *disc;
    check(samara_body_load(words[1], &ellipsoid, error, sizeof error));
    check(samara_body_load(words[2], &disc, error, sizeof error));
    std::printf("A single body after 1 s, Bullet beside samara:\n");
    for (const double step : {0.004, 0.002, 0.001, 0.0005}) {
        std::printf("  step %6.4f s  off by %7.4f %%\n", step, 100.0 * difference(ellipsoid, step));
    }
    swing_on_a_hinge(ellipsoid);
    lie_down(disc);
    samara_body_free(ellipsoid);
    samara_body_free(disc);
    return 0;
} catch (const std::exception& caught) {
    std::fprintf(stderr, "bullet-fall: %s\n", caught.what());
    return 1;
}
