// Rapier, in float. Its programming interface has no functions of rotations, and a step does not compute an exponential:
// it adds first-order increments, of at most pi/4 together. What is measured is where a collider is that sits at p in a
// body with the orientation Q.
const rapier = require("@dimforge/rapier3d-compat");
const {serve} = require("./library.js");

rapier.init().then(() => {
  const world = new rapier.World({x: 0, y: 0, z: 0});
  const body = world.createRigidBody(rapier.RigidBodyDesc.fixed());
  const collider = world.createCollider(rapier.ColliderDesc.ball(1), body);

  function rotate_point([x, y, z, w, px, py, pz]) {
    body.setRotation({x, y, z, w}, true);
    collider.setTranslationWrtParent({x: px, y: py, z: pz});
    world.propagateModifiedBodyPositionsToColliders();
    const p = collider.translation();
    return [p.x, p.y, p.z];
  }

  serve("@dimforge/rapier3d-compat", ["float"], {rotate_point});
});
