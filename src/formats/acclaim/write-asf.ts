/**
 * Writes `.asf`. A joint starts at the tip of the bone above: one whose children and End Sites are all at one point has
 * that as its tip, and all others no length. A child away from there gets a bone without DOFs before it, `CHILD_link`;
 * an End Site a bone of its own, `JOINT_end`. A root of another name than `root` is followed by a bone of that name.
 *
 * What a file said of its bones is written as it was, as long as it still makes the same skeleton.
 */
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import { scaled, unit, type Vec3 } from '../../math/vec3.ts';
import { acclaimMotionOf } from '../../model/skeleton/joint-types.ts';
import type {
  AcclaimBone,
  AcclaimHeader,
  AcclaimMotion,
  Joint,
  Limit,
  Skeleton,
} from '../../model/skeleton/skeleton.ts';
import { isUnlimited } from '../../model/skeleton/skeleton.ts';
import { boneDirection } from '../../model/skeleton/stretch.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';
import { ROOT } from './bones.ts';
import { boneNames, fileName, freeName } from './names.ts';

/** What a skeleton that was read from no `.asf` says of itself: degrees, and a unit of an inch. */
const PLAIN: AcclaimHeader = { version: '1.10', units: ['mass 1.0'], length: 1, angle: 'deg' };

/**
 * Writes a `.asf`: a skeleton whose joints are all Acclaim bones.
 * @param fileName appears in diagnostics
 * @throws Error for other joints
 */
export function writeAsf(skeleton: Skeleton, fileName = ''): WriteResult {
  return new Writing(skeleton, new Text(fileName)).result();
}

/** A bone of the file. */
interface Written {
  readonly name: string;
  readonly parent: string;
  readonly bone: AcclaimBone;
  readonly joint?: Joint;
}

class Writing {
  private readonly header: AcclaimHeader;
  private readonly bones: Written[] = [];

  constructor(
    private readonly skeleton: Skeleton,
    private readonly text: Text,
  ) {
    this.header = skeleton.acclaim ?? PLAIN;
  }

  result(): WriteResult {
    const { text, skeleton, header } = this;
    const [root] = skeleton.joints;
    this.layOut();
    text.line(0, `:version ${header.version ?? '1.10'}`);
    text.line(0, `:name ${header.name ?? (fileName(skeleton.name) || 'skeleton')}`);
    text.line(0, ':units');
    for (const line of header.units) text.line(1, line);
    text.about('the unit');
    text.line(1, `length ${text.number(header.length)}`);
    text.line(1, `angle ${header.angle}`);
    if (header.documentation) {
      text.line(0, ':documentation');
      for (const line of header.documentation) text.line(1, line);
    }
    text.about('the root');
    const { dofs, axes, order } = motionOf(root);
    text.line(0, ':root');
    text.line(1, ['order', ...dofs.map((dof) => dof.toUpperCase())].join(' '));
    text.line(1, `axis ${order.toUpperCase()}`);
    text.line(1, `position ${text.numbers(root.offset)}`);
    text.line(1, `orientation ${this.angles(axes, order)}`);
    text.line(0, ':bonedata');
    for (const [i, bone] of this.bones.entries()) this.bone(bone, i);
    this.hierarchy();
    return text.result();
  }

  /** The bones, in the order of the joints. */
  private layOut(): void {
    const { skeleton, bones } = this;
    const { joints } = skeleton;
    const names = boneNames(skeleton);
    const taken = new Map(names.map((name) => [name, 1]));
    const children = joints.map((): number[] => []);
    joints.forEach(({ parent }, j) => {
      if (parent >= 0) children[parent].push(j);
    });
    const tips = joints.map((joint, j) =>
      tipOf(
        joint,
        children[j].map((c) => joints[c].offset),
        j === 0,
      ),
    );
    const rootName = fileName(joints[0].name);
    // What hangs on the root, and starts there.
    const base = rootName === '' || rootName.toLowerCase() === ROOT ? ROOT : freeName(rootName, taken);
    if (base !== ROOT) bones.push({ name: base, parent: ROOT, bone: NO_BONE });
    joints.forEach((joint, j) => {
      // Tells names that had to change.
      this.text.name(joint.name, 'joint');
      const above = joint.parent === 0 ? base : joint.parent < 0 ? '' : names[joint.parent];
      let parent = above;
      if (j > 0 && !isSame(tips[joint.parent], joint.offset)) {
        parent = freeName(`${names[j]}_link`, taken);
        bones.push({ name: parent, parent: above, bone: boneTo(joint.offset) });
      }
      if (j > 0) bones.push({ name: names[j], parent, bone: this.boneOf(joint, tips[j]), joint });
      for (const end of joint.endSites ?? []) {
        if (isSame(tips[j], end) && j > 0) continue;
        bones.push({ name: freeName(`${names[j]}_end`, taken), parent: j === 0 ? base : names[j], bone: boneTo(end) });
      }
    });
  }

  /** As the file had it, if its tip is still there. */
  private boneOf({ bone }: Joint, tip: Vec3): AcclaimBone {
    const along = bone && boneDirection(bone.direction);
    const isOwn = bone && isSame(along ? scaled(along, bone.length) : [0, 0, 0], tip);
    if (isOwn) return bone;
    return { ...boneTo(tip), ...(bone?.id !== undefined && { id: bone.id }), ...(bone?.kept && { kept: bone.kept }) };
  }

  private bone({ name, bone, joint }: Written, index: number): void {
    const { text } = this;
    text.about(`the bone ${name}`);
    text.line(1, 'begin');
    text.line(2, `id ${bone.id ?? index + 1}`);
    text.line(2, `name ${name}`);
    text.line(2, `direction ${text.numbers(bone.direction)}`);
    text.line(2, `length ${text.number(bone.length)}`);
    const { dofs = [], axes = ZERO, order = 'xyz' } = joint ? motionOf(joint) : {};
    text.line(2, `axis ${this.angles(axes, order)} ${order.toUpperCase()}`);
    if (dofs.length > 0) text.line(2, `dof ${dofs.join(' ')}`);
    if (joint && !joint.limits.every(isNone)) {
      joint.limits.forEach((limit, d) => {
        const isAngle = dofs[d].startsWith('r');
        text.line(
          2,
          `${d === 0 ? 'limits' : '      '} (${this.limit(limit.min, isAngle)} ${this.limit(limit.max, isAngle)})`,
        );
      });
    }
    for (const line of bone.kept ?? []) text.line(2, line);
    text.line(1, 'end');
  }

  private limit(value: number, isAngle: boolean): string {
    if (!Number.isFinite(value)) return value > 0 ? 'inf' : '-inf';
    return this.text.number(isAngle ? this.angle(value) : value);
  }

  /** In the order of their letters. */
  private angles(axes: Vec3, order: string): string {
    return this.text.numbers([...order].map((letter) => this.angle(axes['xyz'.indexOf(letter)])));
  }

  private angle(radians: number): number {
    return this.header.angle === 'deg' ? degreesOf(radians) : radians;
  }

  private hierarchy(): void {
    const { text, bones } = this;
    const children = new Map<string, string[]>([[ROOT, []]]);
    for (const { name, parent } of bones) {
      const list = children.get(parent);
      if (list) list.push(name);
      else children.set(parent, [name]);
    }
    text.line(0, ':hierarchy');
    text.line(1, 'begin');
    for (const [name, below] of children) text.line(2, [name, ...below].join(' '));
    text.line(1, 'end');
  }
}

const ZERO: Vec3 = [0, 0, 0];
/** Bones of less have no direction. */
const SHORTEST = 1e-100;
/** Without a length any direction will do, but none is divided by 0. */
const NO_BONE: AcclaimBone = { direction: [0, 0, 1], length: 0 };

function boneTo(tip: Vec3): AcclaimBone {
  // Of a length that is hardly a number, no direction is left.
  const length = Math.hypot(...tip);
  const direction = length > SHORTEST ? unit(tip) : undefined;
  return direction ? { direction, length } : NO_BONE;
}

/** Where all that follows a joint is, if that is one point; the root has no bone. */
function tipOf({ endSites = [] }: Joint, children: readonly Vec3[], isRoot: boolean): Vec3 {
  const [first, ...others] = [...children, ...endSites];
  return !isRoot && first && others.every((other) => isSame(first, other)) ? first : ZERO;
}

/** Relative difference of points that are the same but for rounding. */
const ROUNDED = 1e-12;

function isSame(a: Vec3, b: Vec3): boolean {
  const size = ROUNDED * Math.max(...a.map(Math.abs), ...b.map(Math.abs));
  return a.every((v, k) => Math.abs(v - b[k]) <= size);
}

/** Written as no limit at all. */
function isNone(limit: Limit): boolean {
  return Number.isFinite(limit.min) && Number.isFinite(limit.max) && isUnlimited(limit);
}

function motionOf(joint: Joint): AcclaimMotion {
  const motion = acclaimMotionOf(joint.motion);
  if (motion) return motion;
  throw new Error(`${joint.name || 'A joint'} has another type than an Acclaim bone. Convert it first.`);
}

/** Digits of decimals that any double keeps. */
const SAFE_DIGITS = 15;

/** Degrees that are read as these radians, of few digits if there are such. */
export function degreesOf(radians: number): number {
  // Zeros keep their sign.
  if (radians === 0) return radians;
  const degrees = radians / RADIANS_PER_DEGREE;
  const short = Number(degrees.toPrecision(SAFE_DIGITS));
  return short * RADIANS_PER_DEGREE === radians ? short : degrees;
}
