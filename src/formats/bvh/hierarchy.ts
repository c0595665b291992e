/**
 * The skeletons of a `.bvh`.
 *
 *     root     = ROOT [NAME] "{" { token } "}"
 *     token    = OFFSET x y z | CHANNELS n { CHANNEL } | JOINT [NAME] "{" { token } "}" | End Site "{" [OFFSET x y z] "}"
 *
 * OFFSET takes six numbers, too, as SOMA writes it: the last three are angles of a rest orientation, which turns
 * nothing.
 *
 * A NAME is the rest of its line up to a `{`, including blanks, colons and `#`. So is anything after `End`: there are
 * files with `End Site20`. Joints are kept on an explicit stack, since they may be nested to any depth.
 *
 * A joint without CHANNELS has none, one without OFFSET is at its parent; both are warnings, since every exporter
 * writes them. Many files have End Sites without OFFSET.
 */
import type { Vec3 } from '../../math/vec3.ts';
import {
  type BvhChannel,
  type BvhMotion,
  DEFAULT_BOX,
  type Joint,
  type Limit,
  UNLIMITED,
} from '../../model/skeleton/skeleton.ts';
import { braceTooMany, type GrammarPart, looksNumeric, number, numbers, openBrace, skipStrange } from '../grammar.ts';
import { OPEN_JOINT } from '../open-joint.ts';
import { ParseError } from '../report.ts';
import type { Mark, Tokens } from '../tokens.ts';
import { shortName } from '../words.ts';
import { CHANNELS_BY_NAME } from './channels.ts';

/** A tree of joints, and the first one's name in the file. */
export interface Root {
  readonly name: string;
  readonly joints: readonly Joint[];
}

const KEYWORDS = new Set(['hierarchy', 'root', 'joint', 'end', 'offset', 'channels', 'motion']);

/** Characters may walk any distance in any unit. */
const NO_LIMIT: Limit = { min: Number.NEGATIVE_INFINITY, max: Number.POSITIVE_INFINITY };

/** A joint that is not closed yet. */
interface OpenJoint {
  readonly index: number;
  readonly parent: number;
  readonly keyword: 'ROOT' | 'JOINT';
  readonly name: string;
  readonly place: Mark;
  offset: Offset | undefined;
  channels: readonly BvhChannel[] | undefined;
  endSites: Offset[] | undefined;
}

/** The numbers of an OFFSET. */
interface Offset {
  readonly at: Vec3;
  readonly rest?: Vec3;
}

/** The tree that is read: its joints, and those that are not closed. */
interface Open {
  readonly joints: Joint[];
  readonly stack: OpenJoint[];
  /** Whether an OFFSET with a rest orientation was told. */
  toldRest: boolean;
}

/**
 * Everything up to `MOTION`, which is then the current token.
 * @throws ParseError, already reported, if the file does not start with HIERARCHY or can't be read on
 */
export function* hierarchy(t: Tokens): GrammarPart<readonly Root[]> {
  const roots: Root[] = [];
  // One list for all: of ten thousand roots, each would take more than its joints.
  const open: Open = { joints: [], stack: [], toldRest: false };
  yield* t.next();
  if (t.keyword() !== 'hierarchy') {
    t.error('hierarchy-missing', `Expected HIERARCHY at the start of a .bvh file, found ${t.found()}.`);
    throw new ParseError('hierarchy-missing');
  }
  for (;;) {
    const kind = yield* t.next();
    const word = t.keyword();
    if (word === 'root') roots.push(yield* tree(t, open));
    else if (word === 'motion') break;
    else if (kind === '}') braceTooMany(t);
    else {
      // An error in any case, or joints might be dropped silently.
      const code = kind === 'end' ? 'motion-missing' : 'keyword-unexpected';
      t.error(code, `Expected ${roots.length > 0 ? 'MOTION' : 'ROOT'}, found ${t.found()}.`);
      throw new ParseError(code);
    }
  }
  if (roots.length === 0) t.error('joint-missing', 'Expected at least one ROOT before MOTION, found none.');
  return roots;
}

/** A root and its descendants. The current token is `ROOT`. */
function* tree(t: Tokens, open: Open): GrammarPart<Root> {
  const { joints, stack } = open;
  joints.length = 0;
  joints.push(OPEN_JOINT);
  const root = yield* head(t, 'ROOT', 0, -1);
  stack.push(root);
  for (let joint: OpenJoint | undefined = root; joint; joint = stack.at(-1)) {
    const kind = yield* t.next();
    if (kind === '}') {
      joints[joint.index] = close(t, joint);
      t.forgetFrom(joint.place);
      stack.pop();
      continue;
    }
    if (kind === 'end') t.failAtEnd(joint.place, describe(joint));
    switch (t.keyword()) {
      case 'joint':
        stack.push(yield* head(t, 'JOINT', joints.length, joint.index));
        joints.push(OPEN_JOINT);
        break;
      case 'offset':
        if (joint.offset) t.error('offset-repeated', `OFFSET appears a second time in ${describe(joint)}.`);
        joint.offset = yield* offsetOf(t, open);
        break;
      case 'channels':
        if (joint.channels) t.error('channels-repeated', `CHANNELS appears a second time in ${describe(joint)}.`);
        joint.channels = yield* channels(t);
        break;
      case 'end':
        joint.endSites ??= [];
        joint.endSites.push(yield* endSite(t, open));
        break;
      case 'root':
      case 'motion': {
        const opened = `opened on line ${t.placeOf(joint.place).line}`;
        t.error('brace-missing', `Expected "}" to close ${describe(joint)}, ${opened}, found ${t.found()}.`);
        throw new ParseError('brace-missing');
      }
      default:
        yield* skipStrange(t, describe(joint), 'OFFSET, CHANNELS, JOINT or End Site');
    }
  }
  // A copy has no room to grow.
  return { name: root.name, joints: joints.slice() };
}

/** `[NAME] "{"` */
function* head(t: Tokens, keyword: 'ROOT' | 'JOINT', index: number, parent: number): GrammarPart<OpenJoint> {
  const place = t.mark();
  const name = yield* t.restOfLine();
  yield* openBrace(t, name ? `the name ${shortName(name)}` : keyword);
  return { index, parent, keyword, name, place, offset: undefined, channels: undefined, endSites: undefined };
}

/** After `End`: the point, or 0 0 0 without one. */
function* endSite(t: Tokens, open: Open): GrammarPart<Offset> {
  const opened = t.mark();
  yield* t.restOfLine();
  yield* openBrace(t, 'End Site');
  let offset: Offset | undefined;
  for (;;) {
    const kind = yield* t.next();
    if (kind === '}') break;
    if (kind === 'end') t.failAtEnd(opened, 'an End Site');
    const word = t.keyword();
    if (word === 'offset') {
      if (offset) t.error('offset-repeated', 'OFFSET appears a second time in an End Site.');
      offset = yield* offsetOf(t, open);
    } else if (word === 'channels') {
      const place = t.mark();
      if ((yield* channels(t)).length === 0) continue;
      t.report.error('channels-unexpected', 'An End Site takes no CHANNELS.', t.placeOf(place, 'error'));
    } else if (KEYWORDS.has(word)) {
      t.braceMissing('End Site');
      break;
    } else yield* skipStrange(t, 'an End Site', 'OFFSET');
  }
  t.forgetFrom(opened);
  return offset ?? NO_OFFSET;
}

/** `x y z`, or `x y z rx ry rz` on one line. */
function* offsetOf(t: Tokens, open: Open): GrammarPart<Offset> {
  const [x, y, z] = yield* numbers(t, 3, (i) => `${'xyz'[i]} of OFFSET`, KEYWORDS);
  failIfCut(t);
  const at: Vec3 = [x, y, z];
  const more: number[] = [];
  let place: Mark | undefined;
  for (;;) {
    yield* t.next();
    if (t.kind !== 'word' || t.startsLine || !looksNumeric(t)) break;
    place ??= t.mark();
    more.push(t.value());
    if (Number.isNaN(t.value())) t.notANumber('a number of OFFSET');
  }
  t.again();
  if (!place) return { at };
  const [rx, ry, rz] = more;
  if (more.length !== 3) {
    const message = `Expected 3 numbers after OFFSET, or 6 with a rest orientation, found ${3 + more.length}.`;
    t.report.error('offset-length', message, t.placeOf(place, 'error'));
  } else if (!open.toldRest) {
    open.toldRest = true;
    const message = 'Found 6 numbers after OFFSET, as SOMA writes them: the last 3 are angles of a rest orientation.';
    t.report.info('rest-orientation', message, t.placeOf(place, 'info'), 'kept for saving; they rotate nothing');
  }
  t.forget(place);
  return { at, rest: [rx, ry, rz] };
}

/** `n CHANNEL …`: all of them, even on the following lines. */
function* channels(t: Tokens): GrammarPart<readonly BvhChannel[]> {
  const place = t.mark();
  const declared = yield* number(t, 'the number of channels', KEYWORDS);
  failIfCut(t);
  const all: BvhChannel[] = [];
  let found = 0;
  for (;;) {
    yield* t.next();
    const channel = CHANNELS_BY_NAME.get(t.keyword());
    if (channel) {
      if (all.includes(channel)) t.error('channel-repeated', `Expected each channel once, found ${t.found()} again.`);
      else all.push(channel);
    } else if (t.kind !== 'word' || t.startsLine || KEYWORDS.has(t.keyword())) break;
    else t.error('channel-unknown', `Expected a channel such as Xposition or Zrotation, found ${t.found()}.`);
    found++;
  }
  t.again();
  if (declared !== undefined && declared !== found) {
    const message = `Expected ${declared} channels as declared, found ${found}.`;
    t.report.error('channel-count', message, t.placeOf(place, 'error'));
  }
  t.forget(place);
  return all;
}

/** A file that ends within a list gets only that error, which is reported already. */
function failIfCut(t: Tokens): void {
  if (t.kind === 'end') throw new ParseError('file-cut');
}

/** Called at the joint's `}`. */
function close(t: Tokens, joint: OpenJoint): Joint {
  const { name, parent, endSites } = joint;
  const { at: offset, rest: own } = joint.offset ?? NO_OFFSET;
  const ends = endSites?.some((end) => end.rest) && endSites.map((end) => end.rest);
  const { motion, limits, rest } = motionWith(joint.channels ?? NO_CHANNELS);
  if (!joint.offset) warnMissing(t, joint, 'OFFSET', 'used 0 0 0');
  if (!joint.channels) warnMissing(t, joint, 'CHANNELS', 'it has none');
  return {
    name,
    parent,
    offset,
    box: DEFAULT_BOX,
    motion,
    limits,
    // A position channel that replaces the offset has its value at rest.
    pose: rest ?? motion.channels.map((name) => (isPosition(name) ? offset['xyz'.indexOf(name[1])] : 0)),
    ...(endSites && { endSites: endSites.map(({ at }) => at) }),
    ...((own || ends) && { restAngles: { ...(own && { own }), ...(ends && { ends }) } }),
  };
}

const NO_OFFSET: Offset = { at: [0, 0, 0] };
const NO_CHANNELS: readonly BvhChannel[] = [];

/** Data that joints with the same channels share: a joint would take a hundred times its bytes otherwise. */
interface Shared {
  readonly motion: BvhMotion;
  readonly limits: readonly Limit[];
  /** Absent with position channels, which rest at the joint's own offset. */
  readonly rest?: readonly number[];
}

/** One for each order of channels, of which there are less than two thousand. */
const SHARED = new Map<string, Shared>();

function motionWith(channels: readonly BvhChannel[]): Shared {
  const key = channels.join('');
  const known = SHARED.get(key);
  if (known) return known;
  const shared: Shared = {
    motion: { kind: 'bvh', channels, positions: 'replace' },
    limits: channels.map((name) => (isPosition(name) ? NO_LIMIT : UNLIMITED)),
    ...(!channels.some(isPosition) && { rest: channels.map(() => 0) }),
  };
  SHARED.set(key, shared);
  return shared;
}

function warnMissing(t: Tokens, joint: OpenJoint, what: string, assumed: string): void {
  const code = `${what.toLowerCase()}-missing`;
  if (t.report.foldsInto(code, '')) return;
  const message = `Expected ${what} in ${describe(joint)}, found none.`;
  t.report.warnFolded(code, '', message, t.placeOf(joint.place, 'warning'), assumed);
}

function isPosition(channel: BvhChannel): boolean {
  return channel[0] === 't';
}

function describe({ keyword, name }: OpenJoint): string {
  return name ? `${keyword} ${shortName(name)}` : `a ${keyword}`;
}
