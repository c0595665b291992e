/**
 * `.skel`, axis-angle form: a pre-order list of hinges, six numbers each; line ends have no meaning.
 *
 *     file  = joint                                       one tree, and nothing behind it
 *     joint = length ax ay az angle children { joint }    so many joints as `children` says
 *
 *     frame(joint) = tip(parent) · R(axis, angle)         angle in degrees; the root's parent is the identity
 *     tip(joint)   = frame(joint) · T(0, length, 0)
 *
 * In the model this is a hinge joint at its parent's tip, with the angle in radians as its pose. Errors in one joint
 * are reported and reading continues; without a count of children it can't. Remaining children are counted on an
 * explicit stack, since trees may have any depth, and no count allocates anything.
 */
import type { Vec3 } from '../../math/vec3.ts';
import { DEFAULT_BOX, type Joint, type Limit, type Motion, UNLIMITED } from '../../model/skeleton/skeleton.ts';
import { type GrammarPart, looksNumeric } from '../grammar.ts';
import { ParseError } from '../report.ts';
import type { Mark, Tokens } from '../tokens.ts';
import { radiansOf } from './degrees.ts';
import { skelTypeOf } from './joint-types.ts';

/**
 * Whether the first token of a file, the current one, starts this form: it is a number, or meant as one. In a `.axskel`
 * file everything does except a joint type of the hierarchy form.
 */
export function beginsAxisAngle(t: Tokens): boolean {
  if (t.kind !== 'word') return false;
  return looksNumeric(t) || (isAxskel(t.fileName) && !skelTypeOf(t.keyword()));
}

/** Whether a file is in this form by its name. */
export function isAxskel(fileName: string): boolean {
  return /\.axskel$/i.test(fileName);
}

/** Joints with remaining children, the innermost last; packed, since any joint of a file may be one. */
class OpenJoints {
  /** Three numbers for each joint: its index, the line of its count of children, and how many of them are missing. */
  private readonly values: number[] = [];

  get hasAny(): boolean {
    return this.values.length > 0;
  }

  push(index: number, line: number, missing: number): void {
    this.values.push(index, line, missing);
  }

  /** The index of the innermost; -1 without any. */
  get index(): number {
    return this.hasAny ? this.values[this.values.length - 3] : -1;
  }

  get line(): number {
    return this.values[this.values.length - 2];
  }

  get missing(): number {
    return this.values[this.values.length - 1];
  }

  /**
   * The next joint is a child of the innermost, which is closed before its last child: a chain keeps one open joint,
   * however long it is.
   */
  beginChild(): void {
    const { values } = this;
    if (--values[values.length - 1] === 0) values.length -= 3;
  }
}

const LIMITS: readonly Limit[] = [UNLIMITED];
/** Shared values of each kind of value: a file of short numbers has few. */
const MAX_SHARED = 256;

/** Equal values of joints, held once: a joint of twelve bytes of text would take thirty times as much. */
class SharedValues {
  private readonly offsets = new Map<number, Vec3>();
  private readonly poses = new Map<number, readonly number[]>();
  private readonly motions = new Map<string, Motion>();

  /** At the tip of a bone of that length. */
  offset(length: number): Vec3 {
    // As keys of a map, 0 and −0 are the same.
    return Object.is(length, -0) ? [0, length, 0] : sharedIn(this.offsets, length, [0, length, 0]);
  }

  pose(angle: number): readonly number[] {
    return Object.is(angle, -0) ? [angle] : sharedIn(this.poses, angle, [angle]);
  }

  motion(axis: Vec3): Motion {
    const hasMinusZero = axis.some((part) => Object.is(part, -0));
    const motion: Motion = { kind: 'hinge', axis };
    return hasMinusZero ? motion : sharedIn(this.motions, axis.join(' '), motion);
  }
}

function sharedIn<K, V>(known: Map<K, V>, key: K, value: V): V {
  const found = known.get(key);
  if (found !== undefined) return found;
  if (known.size < MAX_SHARED) known.set(key, value);
  return value;
}

/** The whole file, starting at the current token. */
export function* axisAngleTree(t: Tokens): GrammarPart<readonly Joint[]> {
  const joints: Joint[] = [];
  const open = new OpenJoints();
  const shared = new SharedValues();
  /** The last token of the previous joint. */
  let last: Mark | undefined;
  t.again();
  do {
    const parent = open.index;
    const index = joints.length;
    if (last) yield* expectChild(t, joints, open, last);
    const length = yield* boneLength(t, index);
    const axis = yield* axisOf(t, index);
    const angle = yield* number(t, `the angle of joint #${index}, in degrees`);
    const children = yield* childCount(t, index);
    joints.push({
      name: '',
      parent,
      offset: shared.offset(parent < 0 ? 0 : (joints[parent].length ?? 0)),
      box: DEFAULT_BOX,
      motion: shared.motion(axis),
      limits: LIMITS,
      pose: shared.pose(radiansOf(angle)),
      length,
    });
    if (parent >= 0) open.beginChild();
    if (last) t.forget(last);
    last = t.mark();
    if (children > 0) open.push(index, t.lineOf(last), children);
  } while (open.hasAny);
  if ((yield* t.next()) !== 'end') {
    const count = joints.length === 1 ? '1 joint' : `${joints.length} joints`;
    t.error('trailing', `Expected the end of the file after the ${count} of the skeleton, found ${t.found()}.`);
  }
  return joints;
}

/** Reports a missing child at the last joint, since there is no line after it to show. */
function* expectChild(t: Tokens, joints: readonly Joint[], open: OpenJoints, last: Mark): GrammarPart<void> {
  yield* t.next();
  if (t.kind !== 'end') {
    t.again();
    return;
  }
  const { index, line, missing } = open;
  const begun = joints.filter(({ parent }) => parent === index).length;
  const children = begun + missing;
  const wanted = `${children} ${children === 1 ? 'child' : 'children'} of joint #${index}`;
  const message = `Expected ${wanted}, as line ${line} says, found ${begun || 'none'} before the end of the file.`;
  t.report.error('joint-missing', message, t.placeOf(last, 'error'));
  throw new ParseError('joint-missing');
}

function* boneLength(t: Tokens, index: number): GrammarPart<number> {
  const length = yield* number(t, `the length of joint #${index}`);
  if (length < 0) t.error('length-negative', `Expected a length of 0 or more for joint #${index}, found ${t.found()}.`);
  return length;
}

function* axisOf(t: Tokens, index: number): GrammarPart<Vec3> {
  const { errorCount } = t.report;
  const x = yield* number(t, `x of the axis of joint #${index}`);
  const place = x === 0 ? t.mark() : undefined;
  const y = yield* number(t, `y of the axis of joint #${index}`);
  const z = yield* number(t, `z of the axis of joint #${index}`);
  if (place && y === 0 && z === 0 && t.report.errorCount === errorCount) {
    const message = `Expected an axis with a direction for joint #${index}, found 0 0 0.`;
    t.report.error('axis-zero', message, t.placeOf(place, 'error'));
  }
  if (place) t.forget(place);
  return [x, y, z];
}

function* childCount(t: Tokens, index: number): GrammarPart<number> {
  const { errorCount } = t.report;
  const count = yield* number(t, `the number of children of joint #${index}`);
  const what = `a whole number of children for joint #${index}`;
  if (t.report.errorCount > errorCount) throw new ParseError('number-expected');
  if (count % 1 !== 0) {
    t.error('count-fractional', `Expected ${what}, found ${t.found()}.`);
    throw new ParseError('count-fractional');
  }
  if (count < 0) {
    t.error('count-negative', `Expected ${what}, 0 or more, found ${t.found()}.`);
    throw new ParseError('count-negative');
  }
  return count;
}

/** One number. A word that is none is reported and counts as 0; if none can follow, reading stops. */
function* number(t: Tokens, what: string): GrammarPart<number> {
  yield* t.next();
  const value = t.value();
  if (value - value === 0) return value;
  if (t.kind === 'word') {
    t.notANumber(what);
    return 0;
  }
  t.error('number-expected', `Expected ${what}, found ${t.found()}.`);
  throw new ParseError('number-expected');
}
