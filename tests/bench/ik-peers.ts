/**
 * The other solvers of inverse kinematics, each given a skeleton of hinges with lengths as it likes it best: at the
 * angles of its file, with pins at tips. Lengths are divided by the reach.
 *
 * closed-chain-ik is 0.0.3 of the registry, whose current source solves more: damping 0.02, errors clamped at 0.5, 100
 * iterations at most, no pull to a rest pose. Its hinges turn about z, so frames are turned to their axes and back.
 *
 * three.js's CCDIKSolver knows one effector a chain and takes several in turn; it goes round as often as it is told,
 * there being no aim to stop at.
 */
import { Goal } from 'closed-chain-ik/src/core/Goal.js';
import { Joint as ChainJoint } from 'closed-chain-ik/src/core/Joint.js';
import { Link } from 'closed-chain-ik/src/core/Link.js';
import { Solver } from 'closed-chain-ik/src/core/Solver.js';
import { Bone, Skeleton as Bones, BufferGeometry, MeshBasicMaterial, Quaternion, SkinnedMesh, Vector3 } from 'three';
import { CCDIKSolver } from 'three/addons/animation/CCDIKSolver.js';
import { ikProblem, movePin } from '../../src/evaluate/ik/problem.ts';
import { type IkMode, solve } from '../../src/evaluate/ik/solve.ts';
import { filePose } from '../../src/model/skeleton/dofs.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { tipPin } from '../helpers/ik-cases.ts';

/** A solver with its pins: the first one is dragged. */
export interface Dragger {
  /** Target of the dragged pin, in the file's unit. */
  step(x: number, y: number, z: number): void;
  /** Distance of a pin from its target, in the file's unit. */
  off(pin: number): number;
}

export interface Grip {
  readonly skeleton: Skeleton;
  readonly reach: number;
  /** Joint, x, y, z: the dragged pin first, then those that hold. */
  readonly targets: readonly (readonly number[])[];
}

export function ours({ skeleton, targets }: Grip, mode: IkMode = 'drag'): Dragger {
  const pose = Float64Array.from(filePose(skeleton, 0));
  const problem = ikProblem(
    skeleton,
    // In a drag the other pins hold; a click sets all of them, so none does.
    targets.map((target, p) => tipPin(skeleton, target, mode === 'drag' && p > 0)),
    pose,
  );
  return {
    step(x, y, z) {
      movePin(problem, 0, x, y, z);
      solve(problem, pose, mode);
    },
    off: (pin) => problem.result.residuals[pin],
  };
}

const [X, Y, Z, , , TURN_Z] = [0, 1, 2, 3, 4, 5];

/** @param aim part of the reach at which it stops; default 1e-3, ten times ours in a drag */
export function closedChain({ skeleton, reach, targets }: Grip, aim = 1e-3): Dragger {
  const root = new Link();
  const ends: Link[] = [];
  skeleton.joints.forEach(({ parent, motion, length = 0, pose: [angle] }) => {
    if (motion.kind !== 'hinge') throw new Error('only hinges');
    const toAxis = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...motion.axis).normalize());
    const joint = new ChainJoint();
    joint.setQuaternion(...toAxis.toArray());
    joint.setDoF(TURN_Z);
    joint.setDoFValues(angle);
    const bone = new Link();
    const back = toAxis.clone().invert();
    // A link is in its joint's frame: back from the axis, then along the bone.
    const along = new Vector3(0, length / reach, 0).applyQuaternion(back);
    bone.setPosition(along.x, along.y, along.z);
    bone.setQuaternion(...back.toArray());
    (ends[parent] ?? root).addChild(joint);
    joint.addChild(bone);
    ends.push(bone);
  });
  const goals = targets.map(([joint, x, y, z]) => {
    const goal = new Goal();
    goal.setGoalDoF(X, Y, Z);
    goal.setPosition(x / reach, y / reach, z / reach);
    goal.makeClosure(ends[joint]);
    return goal;
  });
  const solver = new Solver(root);
  solver.maxIterations = 100;
  solver.dampingFactor = 0.02;
  solver.translationErrorClamp = 0.5;
  solver.rotationErrorClamp = 0.5;
  solver.restPoseFactor = 0;
  solver.translationConvergeThreshold = aim;
  const place = [0, 0, 0];
  return {
    step(x, y, z) {
      goals[0].setPosition(x / reach, y / reach, z / reach);
      solver.solve();
    },
    off(pin) {
      ends[targets[pin][0]].updateMatrixWorld();
      ends[targets[pin][0]].getWorldPosition(place);
      const [x, y, z] = goals[pin].position;
      return reach * Math.hypot(place[0] - x, place[1] - y, place[2] - z);
    },
  };
}

const ROUNDS = 10;

export function ccd({ skeleton, targets }: Grip): Dragger {
  const bones: Bone[] = [];
  for (const { parent, motion, offset, pose } of skeleton.joints) {
    if (motion.kind !== 'hinge') throw new Error('only hinges');
    const bone = new Bone();
    bone.position.set(...offset);
    bone.quaternion.setFromAxisAngle(new Vector3(...motion.axis).normalize(), pose[0]);
    bones[parent]?.add(bone);
    bones.push(bone);
  }
  const [root] = bones;
  const chains = targets.map(([joint, x, y, z]) => {
    const effector = new Bone();
    effector.position.set(0, skeleton.joints[joint].length ?? 0, 0);
    bones[joint].add(effector);
    const target = new Bone();
    target.position.set(x, y, z);
    const links: { index: number; limitation: Vector3 }[] = [];
    for (let j = joint; j >= 0; j = skeleton.joints[j].parent) {
      const { motion } = skeleton.joints[j];
      if (motion.kind === 'hinge') links.push({ index: j, limitation: new Vector3(...motion.axis).normalize() });
    }
    return { effector, target, links };
  });
  const all = [...bones, ...chains.flatMap(({ effector, target }) => [effector, target])];
  const mesh = new SkinnedMesh(new BufferGeometry(), new MeshBasicMaterial());
  mesh.add(root, ...chains.map(({ target }) => target));
  mesh.bind(new Bones(all));
  mesh.updateMatrixWorld(true);
  const solver = new CCDIKSolver(
    mesh,
    chains.map(({ effector, target, links }) => ({
      effector: all.indexOf(effector),
      target: all.indexOf(target),
      links,
      iteration: ROUNDS,
    })),
  );
  const a = new Vector3();
  const b = new Vector3();
  return {
    step(x, y, z) {
      chains[0].target.position.set(x, y, z);
      chains[0].target.updateMatrixWorld(true);
      solver.update();
    },
    off(pin) {
      const { effector, target } = chains[pin];
      return a.setFromMatrixPosition(effector.matrixWorld).distanceTo(b.setFromMatrixPosition(target.matrixWorld));
    },
  };
}
