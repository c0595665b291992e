/**
 * The part of a `.bvh` after `MOTION`.
 *
 *     "Frames:" n        "Frame Time:" seconds        { row }
 *
 * The number of rows decides; a different declared count is a warning, and one that is no integer an error. An unusable
 * frame time is a warning too, and 1/30 s is used: poses of one frame are written with 0.
 */
import { LONGEST_FRAME, SHORTEST_FRAME } from '../../model/takes/samples.ts';
import { type GrammarPart, number } from '../grammar.ts';
import { ParseError } from '../report.ts';
import type { Mark, Tokens } from '../tokens.ts';
import { Rows } from './rows.ts';

/** Rows with the channels of all roots. */
export interface MotionRows {
  /** 0 if there is no complete row. */
  readonly frameCount: number;
  readonly frameSeconds: number;
  /** `frameCount` rows. */
  readonly values: Float64Array;
}

const KEYWORDS = new Set(['frames', 'frames:', 'frame', 'frametime:', 'time:']);
const COLON = 58;

const ASSUMED = { frameSeconds: 1 / 30, text: 'used 1/30 s' };

interface Header {
  /** The declared number of frames; undefined if it is not a number. */
  frames?: number;
  framesAt?: Mark;
  frameSeconds?: number;
}

/**
 * Reads MOTION: the frame count, the frame time and the rows.
 * @param width number of channels of all roots
 * @param byteLength of the whole file
 */
export function* motion(t: Tokens, width: number, byteLength: number | undefined): GrammarPart<MotionRows> {
  const { frames, framesAt, frameSeconds = ASSUMED.frameSeconds } = yield* header(t);
  const rows = new Rows(t, width, frames, byteLength);
  yield* rows.read();
  const { frameCount } = rows;
  // If rows are broken, a wrong count is not worth mentioning.
  if (framesAt && !t.report.hasErrors) tellCount(t, frames, frameCount, framesAt);
  return { frameCount, frameSeconds, values: rows.all() };
}

/** Up to where both were found; what follows may be the first row. */
function* header(t: Tokens): GrammarPart<Header> {
  const found: Header = {};
  while (!found.framesAt || found.frameSeconds === undefined) {
    const label = yield* labelOf(t);
    if (label === 'frames') {
      found.framesAt = t.mark();
      found.frames = yield* number(t, 'the number of frames', KEYWORDS);
      if (found.frames !== undefined && found.frames % 1 !== 0) {
        t.error('count-fractional', `Expected a whole number of frames, found ${t.found()}.`);
      }
    } else if (label === 'frametime') found.frameSeconds = yield* frameTime(t);
    else {
      const [code, what] = found.framesAt
        ? ['frame-time-missing', '"Frame Time:" and a number of seconds']
        : ['frames-missing', '"Frames:" and a number'];
      t.error(code, `Expected ${what}, found ${t.found()}.`);
      throw new ParseError(code);
    }
  }
  return found;
}

/**
 * Reads `Frames:` or `Frame Time:`, with any blanks, or numbers attached; returns it in lower case without blanks and
 * colon.
 */
function* labelOf(t: Tokens): GrammarPart<string> {
  let label = '';
  do {
    yield* t.next();
    t.endBehind(COLON);
    label += t.keyword();
  } while (label === 'frame' && t.kind === 'word');
  if (label.endsWith(':')) return label.slice(0, -1);
  if (label !== 'frames' && label !== 'frametime') return label;
  yield* t.next();
  t.endBehind(COLON);
  if (t.keyword() !== ':') t.again();
  return label;
}

function* frameTime(t: Tokens): GrammarPart<number> {
  const value = yield* number(t, 'the frame time in seconds', KEYWORDS);
  // A missing one is an error, reported already.
  if (value === undefined) return ASSUMED.frameSeconds;
  if (value >= SHORTEST_FRAME && value <= LONGEST_FRAME) return value;
  const message = `Expected a frame time from ${SHORTEST_FRAME} to ${LONGEST_FRAME} seconds, found ${t.found()}.`;
  t.warn('frame-time', message, ASSUMED.text);
  return ASSUMED.frameSeconds;
}

function tellCount(t: Tokens, declared: number | undefined, found: number, mark: Mark): void {
  if (found > 0 && (declared === undefined || declared === found)) return;
  const place = t.placeOf(mark, 'warning');
  if (found > 0) {
    t.report.warn('count-mismatch', `Expected ${declared} frames as declared, found ${found}.`, place, `used ${found}`);
  } else {
    const expected = declared ? `${declared} frames as declared` : 'rows of channel values';
    t.report.warn('frames-none', `Expected ${expected}, found none.`, place, 'opened the skeleton without motion');
  }
}
