/**
 * `.pose`, our own format: named poses of a character, by the names of joints and DOFs.
 *
 *     poses = { pose }
 *     pose  = "pose" [NAME] "{" { root x y z | joint | weight VALUE NAME } "}"
 *     joint = "joint" [NAME] "{" { DOF VALUE } "}"              DOF as `.skel` spells it: rx, tx, qw …
 *
 * A NAME is the rest of its line, up to a brace. Joints are in the order of the skeleton, which distinguishes those of
 * the same name; DOFs that a pose does not contain are not changed by it.
 */
import type { Vec3 } from '../../math/vec3.ts';
import { DOF_NAMES } from '../../model/joint-types/dof.ts';
import type { NamedValue, PoseByNames, PosedJoint } from '../../model/pose-by-names.ts';
import {
  braceTooMany,
  type GrammarPart,
  number,
  numbers,
  openBrace,
  skipStrange,
  stemOfName,
  warnRepeated,
} from '../grammar.ts';
import { WHOLE_FILE } from '../places.ts';
import { grammarReader, type Reader, type ReadResult, readWhole } from '../reader.ts';
import type { Tokens } from '../tokens.ts';

/** A reader for a `.pose`: at least one pose. */
export function poseReader(fileName: string): Reader<readonly PoseByNames[]> {
  return grammarReader(fileName, poseFile);
}

/** Reads a whole `.pose`. */
export function readPoses(bytes: Uint8Array | string, fileName: string): ReadResult<readonly PoseByNames[]> {
  return readWhole(poseReader(fileName), bytes);
}

const DOFS: ReadonlySet<string> = new Set(DOF_NAMES);
const IN_FILE = new Set(['pose']);
const IN_POSE = new Set(['joint']);
const KEYWORDS = new Set(['pose', 'root', 'joint', 'weight', ...DOF_NAMES]);

function* poseFile(t: Tokens): GrammarPart<readonly PoseByNames[]> {
  const poses: PoseByNames[] = [];
  for (;;) {
    const kind = yield* t.next();
    if (kind === 'end') break;
    if (kind === '}') braceTooMany(t);
    else if (t.keyword() === 'pose') poses.push(yield* pose(t, poses.length));
    else yield* skipStrange(t, 'a .pose file', 'pose', IN_FILE);
  }
  if (poses.length === 0) t.report.error('pose-missing', 'Expected pose NAME { … }, found none.', WHOLE_FILE);
  return poses;
}

function* pose(t: Tokens, index: number): GrammarPart<PoseByNames> {
  const opened = t.mark();
  const stem = stemOfName(t.fileName);
  const name = (yield* t.restOfLine()) || (index === 0 ? stem : `${stem} ${index + 1}`);
  yield* openBrace(t, 'the name of the pose');
  let root: Vec3 | undefined;
  const joints: PosedJoint[] = [];
  const weights: NamedValue[] = [];
  for (;;) {
    const kind = yield* t.next();
    if (kind === '}') break;
    if (kind === 'end') t.failAtEnd(opened, 'the pose');
    const word = t.keyword();
    if (word === 'root') {
      if (root) warnRepeated(t, word);
      const [x, y, z] = yield* numbers(t, 3, (i) => `${'xyz'[i]} of the root`, KEYWORDS);
      root = [x, y, z];
    } else if (word === 'joint') joints.push(yield* joint(t));
    else if (word === 'weight') {
      const value = yield* number(t, 'a weight', KEYWORDS);
      if (value !== undefined) weights.push({ name: yield* t.restOfLine(), value });
    } else yield* skipStrange(t, 'a pose', 'root, joint or weight', IN_POSE);
  }
  t.forgetFrom(opened);
  return { name, ...(root && { root }), joints, weights };
}

function* joint(t: Tokens): GrammarPart<PosedJoint> {
  const opened = t.mark();
  const name = yield* t.restOfLine();
  yield* openBrace(t, 'the name of the joint');
  const dofs = new Map<string, number>();
  for (;;) {
    const kind = yield* t.next();
    if (kind === '}') break;
    if (kind === 'end') t.failAtEnd(opened, 'the joint');
    const word = t.keyword();
    if (!DOFS.has(word)) {
      yield* skipStrange(t, 'a joint of a pose', 'a DOF such as rx');
      continue;
    }
    if (dofs.has(word)) warnRepeated(t, word);
    const value = yield* number(t, `the value of ${word}`, KEYWORDS);
    if (value !== undefined) dofs.set(word, value);
  }
  t.forgetFrom(opened);
  return { name, dofs: [...dofs].map(([dof, value]) => ({ name: dof, value })) };
}
