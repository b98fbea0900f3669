// What a user would take instead of a part of samara, measured in the same run: MuJoCo's step with its fluid
// model, Bullet's for bodies that touch. Compiled where these are installed.

#include <benchmark/benchmark.h>

#ifdef SAMARA_MUJOCO
#include <array>
#include <cstring>
#include <memory>
#include <string>

#include <mujoco/mujoco.h>
#endif

#ifdef SAMARA_BULLET
#include <memory>
#include <random>
#include <vector>

#include <BulletCollision/CollisionShapes/btShapeHull.h>
#include <btBulletDynamicsCommon.h>

#include "samara/core/body/body_file.hpp"
#include "samara/scene/ready_bodies.hpp"
#endif

namespace samara {
namespace {

#ifdef SAMARA_MUJOCO
/// The ellipsoid of step_with_tables in MuJoCo's water, all but gravity and fluid switched off. Its
/// documentation advises `implicit` for fluid forces.
void mujoco_step(benchmark::State& state) {
    const std::string text =
        "<mujoco><option integrator='implicit' density='998.2' viscosity='1.002e-3' timestep='0.002' "
        "gravity='0 0 -1.65'/><worldbody><body><freejoint/><geom type='ellipsoid' size='0.01 0.02 0.04' "
        "density='1200' fluidshape='ellipsoid' contype='0' conaffinity='0'/></body></worldbody></mujoco>";
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "body.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    std::array<char, 1000> error{};
    const std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model(
        mj_loadXML("body.xml", files.get(), error.data(), error.size()), mj_deleteModel);
    mj_deleteVFS(files.get());
    if (!model) return state.SkipWithError(error.data());
    model->opt.disableflags = mjDSBL_CONSTRAINT | mjDSBL_EQUALITY | mjDSBL_FRICTIONLOSS | mjDSBL_LIMIT |
                              mjDSBL_CONTACT | mjDSBL_CLAMPCTRL | mjDSBL_WARMSTART | mjDSBL_ACTUATION |
                              mjDSBL_SENSOR;
    const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_makeData(model.get()), mj_deleteData);
    while (state.KeepRunning()) mj_step(model.get(), data.get());
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(mujoco_step);
#endif

#ifdef SAMARA_BULLET
struct World {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    std::vector<std::unique_ptr<btRigidBody>> bodies;

    World() { world.setGravity({0, 0, btScalar(-9.81)}); }
    World(const World&) = delete;
    ~World() {
        for (const auto& body : bodies) world.removeRigidBody(body.get());
    }
    void add(btCollisionShape& shape, double mass, const btTransform& place) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0.0) shape.calculateLocalInertia(btScalar(mass), inertia);
        bodies.push_back(std::make_unique<btRigidBody>(btScalar(mass), nullptr, &shape, inertia));
        bodies.back()->setWorldTransform(place);
        bodies.back()->setFriction(btScalar(0.5));
        world.addRigidBody(bodies.back().get());
    }
};

/// The heap of docs/scenes/heap.toml, 4 s of 60 leaves: their convex hulls, poured onto a plane in a vacuum,
/// in steps of 1/240 s as game engines take.
void bullet_heap(benchmark::State& state) {
    const Body leaf = read_body_file(ready_body_file("leaf"));
    btConvexHullShape whole;
    for (const Vector3d& vertex : leaf.surface.vertices) {
        whole.addPoint({btScalar(vertex.x()), btScalar(vertex.y()), btScalar(vertex.z())}, false);
    }
    whole.recalcLocalAabb();
    btShapeHull simpler(&whole);  // of 42 points, as Bullet's manual advises
    simpler.buildHull(0);
    btConvexHullShape hull(&simpler.getVertexPointer()->getX(), simpler.numVertices());
    hull.setMargin(btScalar(0.0005));
    btStaticPlaneShape level({0, 0, 1}, 0);
    while (state.KeepRunning()) {
        World heap;
        heap.add(level, 0.0, btTransform::getIdentity());
        std::mt19937 random(1);
        const auto between = [&](double most) { return std::uniform_real_distribution(-most, most)(random); };
        for (int step = 0; step < 960; ++step) {
            if (step % 6 == 0 && step < 360) {
                const btQuaternion orientation(btScalar(between(3.1)), btScalar(between(3.1)), 0);
                heap.add(hull, 6e-5,
                         btTransform(orientation, {btScalar(between(0.03)), btScalar(between(0.03)),
                                                   btScalar(0.4 + between(0.1))}));
            }
            heap.world.stepSimulation(btScalar(1.0 / 240), 0, btScalar(1.0 / 240));
        }
    }
}
BENCHMARK(bullet_heap)->Unit(benchmark::kMillisecond);

/// The block of slide_on_sheet: on two triangles, or on so many times as many.
void bullet_slide_on_sheet(benchmark::State& state) {
    const auto n = static_cast<int>(state.range(0));
    btTriangleMesh sheet;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const auto corner = [&](int a, int b) {
                return btVector3(btScalar(2.0 * (i + a) / n - 1.0), btScalar(2.0 * (j + b) / n - 1.0), 0);
            };
            sheet.addTriangle(corner(0, 0), corner(1, 0), corner(1, 1));
            sheet.addTriangle(corner(0, 0), corner(1, 1), corner(0, 1));
        }
    }
    btBvhTriangleMeshShape faces(&sheet, true);
    btBoxShape block({btScalar(0.02), btScalar(0.015), btScalar(0.005)});
    block.setMargin(btScalar(0.0005));
    World slide;
    slide.world.setGravity({7, 0, -7});
    slide.add(faces, 0.0, btTransform::getIdentity());
    slide.add(block, 0.0084, btTransform::getIdentity());
    btRigidBody& sliding = *slide.bodies.back();
    sliding.setActivationState(DISABLE_DEACTIVATION);
    long step = 0;
    while (state.KeepRunning()) {
        if (step++ % 250 == 0) {
            sliding.setWorldTransform(
                btTransform(btQuaternion::getIdentity(), {btScalar(-0.4), 0, btScalar(0.005)}));
            sliding.setLinearVelocity({0, 0, 0});
            sliding.setAngularVelocity({0, 0, 0});
        }
        slide.world.stepSimulation(btScalar(0.002), 0, btScalar(0.002));
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(bullet_slide_on_sheet)->Arg(1)->Arg(20);
#endif

}  // namespace
}  // namespace samara
