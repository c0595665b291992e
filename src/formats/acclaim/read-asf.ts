/**
 * `.asf`, the skeleton of Acclaim.
 *
 *     asf       = { section }                       section = ":" NAME, and lines up to the next one
 *     :units      mass x, length x, angle deg|rad
 *     :root       order TX TY TZ RX RY RZ, axis XYZ, position x y z, orientation a b c
 *     :bonedata   { begin { id n | name NAME | direction x y z | length l | axis a b c [XYZ] | dof rx … | limits (lo hi) … } end }
 *     :hierarchy  begin { PARENT CHILD … } end
 *
 * A bone is a joint where it starts, at the tip of the bone above. `:version`, `:name` and `:documentation` are kept as
 * they are, and so are other lines of bones. Names keep their case, keywords have none.
 */
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import type { Vec3 } from '../../math/vec3.ts';
import {
  ACCLAIM_DOFS,
  type AcclaimDof,
  type AcclaimHeader,
  EULER_ORDERS,
  type EulerOrder,
  type Skeleton,
} from '../../model/skeleton/skeleton.ts';
import { parseDecimal } from '../decimal.ts';
import { stemOfName } from '../grammar.ts';
import { NO_PLACE, WHOLE_FILE } from '../places.ts';
import { bytesReader, type Reader } from '../reader.ts';
import { ParseError, type Report } from '../report.ts';
import { shortName } from '../words.ts';
import { type Bone, bonesInOrder, type Hierarchy, jointsOf, ROOT } from './bones.ts';
import { AcclaimLines } from './lines.ts';

/** A reader for an `.asf`. */
export function asfReader(fileName: string): Reader<Skeleton> {
  return bytesReader(fileName, (bytes, report) => readAsf(bytes, report, stemOfName(fileName)));
}

/** The skeleton of an `.asf`; undefined, with errors in the report, if it is none. @param name of the skeleton */
function readAsf(bytes: Uint8Array, report: Report, name: string): Skeleton | undefined {
  const reading = new Reading(new AcclaimLines(bytes, report));
  reading.sections();
  return reading.skeleton(name);
}

const SECTIONS = [':version', ':name', ':units', ':documentation', ':root', ':bonedata', ':hierarchy', ':skin'];
/** What is used where a `.asf` has no `:root`. */
const ROOT_ORDER: readonly AcclaimDof[] = ['tx', 'ty', 'tz', 'rx', 'ry', 'rz'];

class Reading {
  private readonly units: string[] = [];
  private readonly header: { -readonly [K in keyof AcclaimHeader]: AcclaimHeader[K] } = {
    units: this.units,
    length: 1,
    angle: 'deg',
  };
  private root: Bone = { ...emptyBone(ROOT), dofs: ROOT_ORDER };
  private readonly bones = new Map<string, Bone>();
  private hierarchy: Hierarchy | undefined;
  /** Whether a bone was lost by an error, so that its name is unknown. */
  private hasLostBones = false;

  constructor(private readonly lines: AcclaimLines) {}

  sections(): void {
    const { lines } = this;
    if (!lines.line()) this.fail('file-empty', 'The file is empty: copy or export it again.');
    for (;;) {
      if (lines.words.length > 0) {
        if (!lines.whole().startsWith(':'))
          this.fail('section-missing', `Expected a section such as :root, found "${shortName(lines.text(0))}".`);
        if (!this.section(lines.keyword(0))) return;
      } else if (!lines.line()) return;
    }
  }

  /** Reads the section that the current line opens; the current line is then that of the next, or false at the end. */
  private section(name: string): boolean {
    const { lines, header } = this;
    switch (name) {
      case ':version':
        header.version = lines.rest(1);
        return this.body(() => lines.warnUnknown(name, 'nothing more'));
      case ':name':
        header.name = lines.rest(1);
        return this.body(() => lines.warnUnknown(name, 'nothing more'));
      case ':documentation':
        return this.documentation();
      case ':units':
        return this.body(() => this.unit());
      case ':root':
        return this.body(() => this.rootLine());
      case ':bonedata':
        return this.body(() => this.bone());
      case ':hierarchy':
        return this.tree();
      default:
        if (name !== ':skin') lines.warnUnknown('an .asf file', SECTIONS.join(' '));
        return this.body(() => undefined);
    }
  }

  /** Calls `each` for the lines with words up to the next section; false at the end of the file. */
  private body(each: () => void): boolean {
    const { lines } = this;
    while (lines.line()) {
      if (lines.whole().startsWith(':')) return true;
      if (lines.words.length > 0) each();
    }
    return false;
  }

  private documentation(): boolean {
    const { lines, header } = this;
    const first = lines.rest(1);
    const kept = first ? [first] : [];
    header.documentation = kept;
    while (lines.line()) {
      const text = lines.whole();
      if (text.startsWith(':')) return true;
      kept.push(text);
    }
    return false;
  }

  private unit(): void {
    const { lines, header } = this;
    const word = lines.keyword(0);
    if (word === 'length') {
      const length = lines.number(1, 'the unit of length');
      if (length === undefined) return;
      if (length > 0) header.length = length;
      else lines.error('unit-length', `Expected a positive unit of length, found ${length}.`, 1);
    } else if (word === 'angle') {
      const angle = lines.keyword(1);
      if (/^deg(rees?)?$/.test(angle)) header.angle = 'deg';
      else if (/^rad(ians?)?$/.test(angle)) header.angle = 'rad';
      else lines.error('unit-angle', `Expected deg or rad, found "${shortName(lines.text(1))}".`, 1);
    } else this.units.push(lines.rest(0));
  }

  private rootLine(): void {
    const { lines, root } = this;
    const word = lines.keyword(0);
    if (word === 'order') root.dofs = this.dofs('order', ROOT_ORDER);
    else if (word === 'axis') root.order = this.order(1) ?? root.order;
    else if (word === 'position') root.position = this.vector('the position');
    else if (word === 'orientation') root.axes = this.vector('the orientation');
    else lines.warnUnknown(':root', 'order, axis, position or orientation');
  }

  /** From `begin` to `end`. */
  private bone(): void {
    const { lines } = this;
    if (lines.keyword(0) !== 'begin') {
      lines.warnUnknown(':bonedata', 'begin');
      return;
    }
    const opened = lines.start;
    const at = lines.place(0);
    const bone: Bone = emptyBone('', opened);
    while (lines.line()) {
      const word = lines.keyword(0);
      if (word === 'end') {
        if (bone.name !== '' && !this.bones.has(bone.name)) {
          this.bones.set(bone.name, bone);
          return;
        }
        this.hasLostBones = true;
        if (bone.name === '') lines.report.error('bone-unnamed', 'Expected the name of this bone, found none.', at);
        else lines.report.error('bone-repeated', `There are two bones called "${shortName(bone.name)}".`, at);
        return;
      }
      if (word === 'begin' || lines.whole().startsWith(':')) break;
      if (lines.words.length > 0) this.boneLine(bone, word);
    }
    const called = bone.name === '' ? 'this bone' : `the bone "${shortName(bone.name)}"`;
    lines.report.error('end-missing', `Expected end after ${called}, found none.`, at);
    throw new ParseError('end-missing');
  }

  private boneLine(bone: Bone, word: string): void {
    const { lines } = this;
    switch (word) {
      case 'id':
        bone.id = lines.rest(1);
        break;
      case 'name':
        bone.name = lines.text(1);
        bone.at = lines.words[1]?.from ?? bone.at;
        break;
      case 'direction':
        bone.direction = this.vector('the direction');
        bone.directionAt = lines.words[0].from;
        break;
      case 'length':
        bone.length = lines.number(1, 'the length of the bone') ?? 0;
        break;
      case 'axis':
        bone.axes = this.vector('the axis');
        if (lines.words.length > 4) bone.order = this.order(4) ?? bone.order;
        break;
      case 'dof':
        bone.dofs = this.dofs('dof', ACCLAIM_DOFS);
        bone.dofAt = lines.words[0].from;
        break;
      case 'limits':
        bone.limitsAt = lines.words[0].from;
        bone.limits = [];
        this.addLimits(bone.limits, 1);
        break;
      default:
        // A row of limits begins with a parenthesis, which is a blank here.
        if (bone.limits && isLimit(lines, 0)) this.addLimits(bone.limits, 0);
        else if (isLimit(lines, 0)) lines.warnUnknown('a bone', 'a keyword such as direction');
        else bone.kept.push(lines.rest(0));
    }
  }

  /** @param from index of the first word that is a limit */
  private addLimits(limits: number[], from: number): void {
    const { lines } = this;
    for (let i = from; i < lines.words.length; i++) {
      const infinite = INFINITE.exec(lines.keyword(i));
      if (infinite) limits.push(infinite[1] === '-' ? Number.NEGATIVE_INFINITY : Number.POSITIVE_INFINITY);
      else limits.push(lines.number(i, 'a limit') ?? 0);
    }
  }

  private vector(what: string): Vec3 {
    const [x, y, z] = ['x', 'y', 'z'].map((axis, i) => this.lines.number(1 + i, `${axis} of ${what}`) ?? 0);
    return [x, y, z];
  }

  private order(index: number): EulerOrder | undefined {
    const { lines } = this;
    const found = EULER_ORDERS.find((order) => order === lines.keyword(index));
    if (!found) {
      lines.error('order-unknown', `Expected an order such as XYZ, found "${shortName(lines.text(index))}".`, index);
    }
    return found;
  }

  private dofs(what: string, known: readonly AcclaimDof[]): readonly AcclaimDof[] {
    const { lines } = this;
    const found: AcclaimDof[] = [];
    for (let i = 1; i < lines.words.length; i++) {
      const dof = known.find((one) => one === lines.keyword(i));
      const text = shortName(lines.text(i));
      if (!dof) lines.error('dof-unknown', `Expected any of ${known.join(' ')} after ${what}, found "${text}".`, i);
      else if (found.includes(dof))
        lines.error('dof-repeated', `Expected each of ${what} once, found ${text} twice.`, i);
      else found.push(dof);
    }
    return found;
  }

  /** `:hierarchy`, from `begin` to `end`. */
  private tree(): boolean {
    const { lines } = this;
    const children = new Map<string, string[]>();
    const parents = new Map<string, string>();
    const places = new Map<string, number>();
    this.hierarchy = { children, parents, places };
    let isOpen = false;
    const opened = lines.place(0);
    while (lines.line()) {
      if (lines.whole().startsWith(':')) break;
      const word = lines.keyword(0);
      if (word === '') continue;
      if (word === 'begin') isOpen = true;
      else if (word === 'end') {
        return this.body(() => lines.warnUnknown(':hierarchy', 'nothing more'));
      } else if (!isOpen) lines.warnUnknown(':hierarchy', 'begin');
      else this.branch(children, parents, places);
    }
    lines.report.error('end-missing', 'Expected end after the hierarchy, found none.', opened);
    throw new ParseError('end-missing');
  }

  private branch(children: Map<string, string[]>, parents: Map<string, string>, places: Map<string, number>): void {
    const { lines } = this;
    const parent = this.known(0);
    if (parent === undefined) return;
    const list = children.get(parent) ?? [];
    children.set(parent, list);
    for (let i = 1; i < lines.words.length; i++) {
      const child = this.known(i);
      if (child === undefined) continue;
      const before = parents.get(child);
      if (child === ROOT) lines.error('root-below', 'The root is listed as a child: it has no parent.', i);
      else if (before !== undefined) {
        const message = `"${shortName(child)}" has two parents, "${shortName(before)}" and "${shortName(parent)}".`;
        lines.error('bone-two-parents', message, i);
      } else {
        parents.set(child, parent);
        places.set(child, lines.words[i].from);
        list.push(child);
      }
    }
  }

  /** The bone that a word names; undefined, and an error, if there is none. */
  private known(index: number): string | undefined {
    const { lines, bones } = this;
    const name = lines.text(index);
    if (bones.has(name)) return name;
    if (name.toLowerCase() === ROOT) return ROOT;
    if (bones.size === 0 || this.hasLostBones) return undefined;
    lines.error(
      'bone-unknown',
      `Expected the name of a bone, found "${shortName(name)}", which :bonedata has not.`,
      index,
    );
    return undefined;
  }

  /** The skeleton of all that was read, if there are no errors. */
  skeleton(name: string): Skeleton | undefined {
    const { lines, bones, header, hierarchy, root } = this;
    const { report } = lines;
    if (bones.size === 0) report.error('bone-missing', 'Expected bones in :bonedata, found none.', NO_PLACE);
    if (!hierarchy) report.error('hierarchy-missing', 'Expected :hierarchy, found none.', NO_PLACE);
    if (report.hasErrors || !hierarchy) return undefined;
    const unit = header.angle === 'deg' ? RADIANS_PER_DEGREE : 1;
    const order = bonesInOrder(root, bones, hierarchy, lines);
    const joints = order && jointsOf(order, unit, lines);
    return joints && !report.hasErrors ? { name, joints, acclaim: header } : undefined;
  }

  private fail(code: string, message: string): never {
    const { lines } = this;
    lines.report.error(code, message, lines.words.length > 0 ? lines.place(0) : WHOLE_FILE);
    throw new ParseError(code);
  }
}

const INFINITE = /^([+-]?)inf(inity)?$/;

function isLimit(lines: AcclaimLines, index: number): boolean {
  const word = lines.words[index];
  const value = word ? parseDecimal(lines.bytes, word.from, word.to) : Number.NaN;
  return value - value === 0 || INFINITE.test(lines.keyword(index));
}

function emptyBone(name: string, at = 0): Bone {
  return {
    name,
    at,
    axes: [0, 0, 0],
    order: 'xyz',
    position: [0, 0, 0],
    direction: [0, 0, 0],
    length: 0,
    dofs: [],
    kept: [],
  };
}
