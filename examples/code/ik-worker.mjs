// Inverse kinematics in a worker: node ik-worker.mjs walker.skel hand_l 0.5 1 0.3
import { readFile } from 'node:fs/promises';
import { isMainThread, parentPort, Worker, workerData } from 'node:worker_threads';
import { ikProblem, movePin, poseAt, solveIk, worldMatrices } from 'marrow/evaluate';
import { readSkel } from 'marrow/formats';
import { createCharacter } from 'marrow/model';

if (isMainThread) {
  const [file, joint, ...target] = process.argv.slice(2);
  const worker = new Worker(new URL(import.meta.url), { workerData: { text: await readFile(file, 'utf8'), joint } });
  worker.on('message', ({ distance, position }) => {
    console.log(`${distance.toExponential(1)} from the target, at ${position.map((x) => x.toFixed(3)).join(' ')}`);
    worker.terminate();
  });
  worker.postMessage(target.map(Number)); // As often as the target moves.
} else {
  const { skeleton } = readSkel(workerData.text);
  const joint = skeleton.joints.findIndex(({ name }) => name === workerData.joint);
  const dofs = poseAt(createCharacter({ skeleton }), 0);
  const world = worldMatrices(skeleton, dofs);
  const pins = [{ joint, point: [0, 0, 0], target: [0, 0, 0] }]; // The point is in the joint's space.
  const problem = ikProblem(skeleton, pins, dofs);
  parentPort.on('message', ([x, y, z]) => {
    movePin(problem, 0, x, y, z);
    const { residuals } = solveIk(problem, dofs); // Changes `dofs`, and allocates nothing.
    worldMatrices(skeleton, dofs, world);
    const position = Array.from(world.subarray(16 * joint + 12, 16 * joint + 15));
    parentPort.postMessage({ distance: residuals[0], position, dofs });
  });
}
