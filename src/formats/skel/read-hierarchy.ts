/**
 * `.skel`, hierarchy form; a file that starts with a number is in the axis-angle form (`read-axis-angle.ts`).
 *
 *     skel   = { joint }                                   several roots: each its own skeleton
 *     joint  = JOINTTYPE [NAME] "{" { token } "}"
 *     token  = offset x y z | boxmin x y z | boxmax x y z | pose v … | rotxlimit min max | … | limit DOF min max
 *            | length l | role NAME | couple DOF JOINT.DOF gain offset | a token of the type's own (joint-types.ts) | joint
 *
 * Joints are kept on an explicit stack, since they may be nested to any depth. What depends on several tokens, which
 * may be in any order, is checked at the joint's `}`; references to other joints at the end of the tree.
 */
import type { Vec3 } from '../../math/vec3.ts';
import { perObject } from '../../model/per-object.ts';
import { dofsOf, takesLimits } from '../../model/skeleton/joint-types.ts';
import {
  type Box,
  DEFAULT_BOX,
  type Dof,
  isUnlimited,
  type Joint,
  type Limit,
  type Motion,
  type Skeleton,
  UNLIMITED,
} from '../../model/skeleton/skeleton.ts';
import { braceTooMany, type GrammarPart, namedHead, number, numberRun, skipStrange, stemOfName } from '../grammar.ts';
import { OPEN_JOINT } from '../open-joint.ts';
import { WHOLE_FILE } from '../places.ts';
import { grammarReader, type Reader } from '../reader.ts';
import type { Mark, Tokens } from '../tokens.ts';
import { couple, type OpenCouple, resolveCouples } from './couples.ts';
import { LIMIT_TOKENS, readOwn, SKEL_TYPES, type SkelType, skelTypeOf } from './joint-types.ts';
import { numberToken, vectorToken } from './own-tokens.ts';
import { axisAngleTree, beginsAxisAngle } from './read-axis-angle.ts';

/** A reader for a `.skel` in the hierarchy or the axis-angle form: a skeleton for each root. */
export function hierarchyReader(fileName: string): Reader<readonly Skeleton[]> {
  return grammarReader(fileName, skeletons);
}

const LIMITS_BY_TOKEN = new Map(Object.entries(LIMIT_TOKENS).map(([dof, token]) => [token, dof]));

const JOINTS = new Set(SKEL_TYPES.map(({ keyword }) => keyword));
const KEYWORDS = new Set([
  ...['offset', 'boxmin', 'boxmax', 'pose', 'limit', 'length', 'role', 'couple'],
  ...LIMITS_BY_TOKEN.keys(),
  ...SKEL_TYPES.flatMap(({ keyword, tokens }) => [keyword, ...tokens.keys()]),
]);

/** More than any joint's number of DOFs: further values of a pose are only counted. */
const KEPT_POSE = 16;

/** A joint that is not closed yet. */
interface OpenJoint {
  readonly index: number;
  readonly parent: number;
  readonly name: string;
  readonly type: SkelType;
  readonly place: Mark;
  /** Links of the tree when it was opened: their places are needed at its end. */
  readonly couplesBefore: number;
  offset: Vec3;
  boxMin: Vec3;
  boxMax: Vec3;
  motion: Motion;
  /** In file order: the last one for a DOF counts. */
  limits: { readonly dof: string; readonly limit: Limit; readonly place: Mark }[] | undefined;
  pose?: { readonly values: number[]; readonly found: number; readonly place: Mark };
  length?: number;
  role?: string;
}

/** The tree that is read. One object for all roots: of ten thousand, each would take more than its joints. */
class OpenTree {
  readonly joints: Joint[] = [];
  readonly stack: OpenJoint[] = [];
  couples: OpenCouple[] = [];

  *open(t: Tokens, type: SkelType): GrammarPart<void> {
    const { joints, stack, couples } = this;
    stack.push(yield* head(t, type, joints.length, stack.at(-1)?.index ?? -1, couples.length));
    joints.push(OPEN_JOINT);
  }

  /** Its joints, and is empty again. */
  close(t: Tokens): readonly Joint[] {
    // A copy has no room to grow.
    const joints = resolveCouples(t, this.joints.slice(), this.couples);
    this.joints.length = 0;
    if (this.couples.length > 0) this.couples = [];
    return joints;
  }
}

function* skeletons(t: Tokens): GrammarPart<readonly Skeleton[]> {
  const roots: (readonly Joint[])[] = [];
  const open = new OpenTree();
  for (let isFirst = true; ; isFirst = false) {
    const kind = yield* t.next();
    if (kind === 'end') break;
    if (kind === '}') {
      braceTooMany(t);
      continue;
    }
    const type = skelTypeOf(t.keyword());
    if (type) {
      if (roots.length === 1) {
        const message = 'Found a second root; each root becomes its own skeleton.';
        t.report.info('several-roots', message, t.place());
      }
      roots.push(yield* tree(t, type, open));
    } else if (isFirst && beginsAxisAngle(t)) {
      return [{ name: stemOfName(t.fileName), joints: yield* axisAngleTree(t), form: 'axis-angle' }];
    } else yield* skipStrange(t, 'a .skel file', 'a joint such as balljoint', JOINTS);
  }
  if (roots.length === 0) t.report.error('joint-missing', 'Expected at least one joint, found none.', WHOLE_FILE);
  const stem = stemOfName(t.fileName);
  return roots.map((joints, i) => ({ name: i === 0 ? stem : `${stem}_${i + 1}`, joints }));
}

/** A root and its descendants. The current token is its joint type. */
function* tree(t: Tokens, rootType: SkelType, open: OpenTree): GrammarPart<readonly Joint[]> {
  const { joints, stack, couples } = open;
  yield* open.open(t, rootType);
  for (let joint = stack.at(-1); joint; joint = stack.at(-1)) {
    const kind = yield* t.next();
    if (kind === '}') {
      joints[joint.index] = close(t, joint);
      if (joint.couplesBefore === couples.length) t.forgetFrom(joint.place);
      stack.pop();
    } else if (kind === 'end') t.failAtEnd(joint.place, describe(joint));
    else {
      const word = t.keyword();
      const type = skelTypeOf(word);
      if (type) yield* open.open(t, type);
      else if (!(yield* token(t, joint, word, couples)))
        yield* skipStrange(t, describe(joint), 'a joint or its tokens', JOINTS);
    }
  }
  return open.close(t);
}

/** `[NAME] "{"` */
function* head(
  t: Tokens,
  type: SkelType,
  index: number,
  parent: number,
  couplesBefore: number,
): GrammarPart<OpenJoint> {
  const place = t.mark();
  const name = yield* namedHead(t, type.keyword, index, KEYWORDS);
  const { min, max } = DEFAULT_BOX;
  return {
    ...{ index, parent, name, type, place, couplesBefore, motion: type.motion },
    ...{ offset: ORIGIN, boxMin: min, boxMax: max, limits: undefined },
  };
}

/** Reads one token of a joint with its values; returns whether it is one. */
function* token(t: Tokens, joint: OpenJoint, word: string, couples: OpenCouple[]): GrammarPart<boolean> {
  switch (word) {
    case 'offset':
      joint.offset = yield* vector(t, word);
      return true;
    case 'boxmin':
      joint.boxMin = yield* vector(t, word);
      return true;
    case 'boxmax':
      joint.boxMax = yield* vector(t, word);
      return true;
    case 'pose': {
      const place = t.mark();
      const { all, found } = yield* numberRun(t, KEPT_POSE, 'a value of the pose', KEYWORDS);
      joint.pose = { values: all, found, place };
      return true;
    }
    case 'length':
      yield* boneLength(t, joint);
      return true;
    case 'role':
      yield* t.next();
      if (t.kind === 'word' && !t.startsLine) joint.role = t.text();
      else {
        t.error('name-expected', `Expected a body part after role, found ${t.found()}.`);
        t.again();
      }
      return true;
    case 'couple': {
      const found = yield* couple(t, joint.index, KEYWORDS);
      if (found) couples.push(found);
      return true;
    }
    case 'limit':
      yield* t.next();
      if (t.kind === 'word' && Number.isNaN(t.value())) yield* limit(t, joint, t.text().toLowerCase());
      else {
        t.error('name-expected', `Expected the name of a DOF after limit, found ${t.found()}.`);
        if (t.kind !== 'word') t.again();
        else yield* numberRun(t, 0, 'a limit', KEYWORDS);
      }
      return true;
  }
  const dof = LIMITS_BY_TOKEN.get(word);
  if (dof !== undefined) {
    yield* limit(t, joint, dof);
    return true;
  }
  const own = joint.type.tokens.get(word);
  if (!own) return false;
  joint.motion = yield* readOwn(t, word, own, joint.motion, KEYWORDS);
  return true;
}

/** `l`, the length of the bone along +y. */
function* boneLength(t: Tokens, joint: OpenJoint): GrammarPart<void> {
  const place = t.mark();
  const length = yield* numberToken(t, 'length', KEYWORDS);
  if (length === undefined) return;
  if (length < 0) {
    const message = `Expected a length of 0 or more for the bone, found ${length}.`;
    t.report.error('length-negative', message, t.placeOf(place, 'error'));
  } else joint.length = length;
}

function* vector(t: Tokens, token: string): GrammarPart<Vec3> {
  return (yield* vectorToken(t, token, KEYWORDS)) ?? [0, 0, 0];
}

/** `min max` */
function* limit(t: Tokens, joint: OpenJoint, dof: string): GrammarPart<void> {
  const place = t.mark();
  const min = yield* number(t, `the lower limit of ${dof}`, KEYWORDS);
  if (min === undefined) return;
  const max = yield* number(t, `the upper limit of ${dof}`, KEYWORDS);
  if (max === undefined) return;
  joint.limits ??= [];
  joint.limits.push({ dof, limit: { min, max }, place });
  if (min > max) {
    const message = `Expected the lower limit of ${dof} first, found ${min} and ${max}.`;
    t.report.warn('limits-crossed', message, t.placeOf(place, 'warning'), 'kept as written, and ignored when clamping');
  }
}

/** Called at the joint's `}`, when everything about it is known. */
function close(t: Tokens, joint: OpenJoint): Joint {
  const { name, parent, offset, motion, pose, limits: given = [] } = joint;
  const dofs = dofsOf(motion);
  const limits = given.length
    ? dofs.map((dof) => given.findLast((g) => g.dof === dof.name)?.limit ?? UNLIMITED)
    : defaultsOf(dofs).limits;
  for (const { dof, place } of given) {
    if (dofs.some((d) => d.name === dof)) continue;
    const names = dofs.map((d) => d.name).join(' ') || 'it has none';
    const message = `Expected a DOF of a ${joint.type.keyword} (${names}), found ${dof}.`;
    t.report.warn('dof-unknown', message, t.placeOf(place, 'warning'), 'limit ignored');
  }
  if (given.length && dofs.length && !takesLimits(motion)) {
    const message = `Found limits on ${describe(joint)}, which can't have any: its DOFs have no meaning on their own.`;
    t.report.warn('limits-not-taken', message, t.placeOf(given[0].place, 'warning'), 'kept, and ignored when clamping');
  }
  const values = pose ? dofs.map((dof, i) => pose.values[i] ?? dof.rest) : defaultsOf(dofs).pose;
  if (pose && pose.found !== dofs.length) {
    const message = `Expected ${dofs.length} values for the pose of a ${joint.type.keyword}, found ${pose.found}.`;
    if (pose.found < dofs.length) t.report.error('number-expected', message, t.placeOf(pose.place, 'error'));
    else t.report.warn('pose-too-long', message, t.placeOf(pose.place, 'warning'), `used the first ${dofs.length}`);
  }
  const outside = dofs.filter((_, i) => takesLimits(motion) && isOutside(values[i], limits[i]));
  if (outside.length > 0) {
    const message = `The pose of ${describe(joint)} is outside its limits in ${outside.map((d) => d.name).join(', ')}.`;
    t.report.info('pose-out-of-limits', message, t.placeOf(pose?.place ?? joint.place, 'info'), 'clamped when shown');
  }
  return {
    ...{ name, parent, offset, box: boxOf(joint), motion, limits, pose: values },
    ...(joint.length !== undefined && { length: joint.length }),
    ...(joint.role !== undefined && { role: joint.role }),
  };
}

/** Default values of joints, shared: written `balljoint{}`, a joint would take fifty times its bytes. */
interface Defaults {
  readonly limits: readonly Limit[];
  readonly pose: readonly number[];
}

const ORIGIN: Vec3 = [0, 0, 0];

const defaultsOf = perObject(
  (dofs: readonly Dof[]): Defaults => ({ limits: dofs.map(() => UNLIMITED), pose: dofs.map(({ rest }) => rest) }),
);

function boxOf({ boxMin, boxMax }: OpenJoint): Box {
  return boxMin === DEFAULT_BOX.min && boxMax === DEFAULT_BOX.max ? DEFAULT_BOX : { min: boxMin, max: boxMax };
}

function isOutside(value: number, limit: Limit): boolean {
  return !isUnlimited(limit) && limit.min <= limit.max && (value < limit.min || value > limit.max);
}

function describe({ type, name }: OpenJoint): string {
  return name ? `${type.keyword} ${name}` : `a ${type.keyword}`;
}
