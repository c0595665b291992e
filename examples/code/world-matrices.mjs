// The world matrix of a joint at a time: node world-matrices.mjs walker.skel walker_walk.anim head 0.5
import { readFile } from 'node:fs/promises';
import { poseAt, worldMatrices } from 'marrow/evaluate';
import { readAnim, readSkel } from 'marrow/formats';
import { createCharacter } from 'marrow/model';

const [skelFile, animFile, jointName, seconds] = process.argv.slice(2);
const { skeleton, diagnostics } = readSkel(await readFile(skelFile), skelFile);
const { take, diagnostics: more } = readAnim(await readFile(animFile), animFile);
for (const { file, line, message } of [...diagnostics, ...more]) console.error(`${file}:${line}: ${message}`);
if (!skeleton || !take) process.exit(1);

const character = createCharacter({ skeleton, takes: [take] });
const dofs = poseAt(character, Number(seconds)); // Radians and lengths; pass an array to use it again.
const world = worldMatrices(skeleton, dofs); // 16 numbers per joint, column-major: 12 to 14 are its place.

const joint = skeleton.joints.findIndex(({ name }) => name === jointName);
if (joint < 0) throw new Error(`Expected a joint, found "${jointName}".`);
console.log(Array.from(world.subarray(16 * joint, 16 * joint + 16)).join(' '));
