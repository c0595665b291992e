/**
 * `.anim`: channels of keys.
 *
 *     anim    = "animation" "{" { range t0 t1 | numchannels n | channel } "}"
 *     channel = "channel" [INDEX] "{" { extrapolate IN OUT | keys k "{" { time value tan_in tan_out } "}" } "}"
 */

import { withAutoRecognised } from '../../model/takes/auto-slope.ts';
import {
  type Channel,
  EXTRAPOLATIONS,
  type Extrapolation,
  type Keys,
  restChannel,
  type Take,
} from '../../model/takes/take.ts';
import {
  blockHead,
  braceTooMany,
  checkCount,
  checkRows,
  countAndBrace,
  type Declared,
  declaredCount,
  type GrammarPart,
  number,
  skipStrange,
  stemOfName,
  warnRepeated,
} from '../grammar.ts';
import { NO_PLACE, WHOLE_FILE } from '../places.ts';
import { grammarReader, type Reader, type ReadResult, readWhole } from '../reader.ts';
import type { Mark, Tokens } from '../tokens.ts';
import { KeySink } from './keys.ts';

/** A reader for a `.anim`. */
export function animReader(fileName: string): Reader<Take> {
  return grammarReader(fileName, animFile);
}

/** Reads a whole `.anim`. */
export function readAnim(bytes: Uint8Array | string, fileName: string): ReadResult<Take> {
  return readWhole(animReader(fileName), bytes);
}

const KEYWORDS = new Set(['animation', 'range', 'numchannels', 'channel', 'extrapolate', 'keys']);
/** Keywords of blocks. */
const IN_FILE = new Set(['animation']);
const IN_ANIMATION = new Set(['channel']);
const IN_CHANNEL = new Set(['keys']);

interface Parts {
  range?: readonly [number, number];
  readonly channels: Channel[];
}

function* animFile(t: Tokens): GrammarPart<Take> {
  let parts: Parts | undefined;
  let place: Mark | undefined;
  for (;;) {
    const kind = yield* t.next();
    if (kind === 'end') break;
    if (kind === '}') braceTooMany(t);
    else if (t.keyword() === 'animation') {
      if (parts) warnRepeated(t, 'animation');
      place = t.mark();
      parts = yield* body(t, place);
    } else yield* skipStrange(t, 'an .anim file', 'animation', IN_FILE);
  }
  if (!parts) t.report.error('animation-missing', 'Expected animation { … }, found none.', WHOLE_FILE);
  else if (parts.channels.length === 0) {
    t.report.error(
      'channel-missing',
      'Expected at least one channel, found none.',
      place ? t.placeOf(place) : WHOLE_FILE,
    );
  }
  const channels = parts?.channels ?? [];
  return { name: stemOfName(t.fileName), range: parts?.range ?? rangeOfKeys(t, channels), channels };
}

/** The default range: first to last key. */
function rangeOfKeys(t: Tokens, channels: readonly Channel[]): readonly [number, number] {
  let first = Number.POSITIVE_INFINITY;
  let last = Number.NEGATIVE_INFINITY;
  for (const channel of channels) {
    if (channel.kind !== 'keys') continue;
    const { times } = channel;
    first = Math.min(first, times[0]);
    last = Math.max(last, times[times.length - 1]);
  }
  const range: readonly [number, number] = first <= last ? [first, last] : [0, 0];
  if (channels.length > 0) {
    t.report.warn('range-missing', 'Expected range t0 t1, found none.', NO_PLACE, `used ${range[0]} to ${range[1]}`);
  }
  return range;
}

function* body(t: Tokens, opened: Mark): GrammarPart<Parts> {
  const parts: Parts = { channels: [] };
  const sink = new KeySink();
  let declared: Declared | undefined;
  yield* blockHead(t, 'animation', 0, KEYWORDS);
  for (;;) {
    const kind = yield* t.next();
    if (kind === '}') break;
    if (kind === 'end') t.failAtEnd(opened, 'the animation');
    switch (t.keyword()) {
      case 'range':
        if (parts.range) warnRepeated(t, 'range');
        parts.range = yield* range(t);
        break;
      case 'numchannels':
        declared = declaredCount(t, 'channels', yield* number(t, 'the number of channels', KEYWORDS));
        break;
      case 'channel':
        parts.channels.push(yield* channel(t, sink, parts.channels.length));
        break;
      default:
        yield* skipStrange(t, 'an animation', 'range, numchannels or channel', IN_ANIMATION);
    }
  }
  if (declared) checkCount(t, 'channels', declared, parts.channels.length);
  return parts;
}

function* range(t: Tokens): GrammarPart<readonly [number, number]> {
  const place = t.mark();
  const first = yield* number(t, 'the start time of the range', KEYWORDS);
  const last = first === undefined ? undefined : yield* number(t, 'the end time of the range', KEYWORDS);
  if (first === undefined || last === undefined) return [0, 0];
  if (first <= last) return [first, last];
  const message = `Expected a range that starts before it ends, found ${first} to ${last}.`;
  t.report.warn('range-reversed', message, t.placeOf(place), 'swapped');
  return [last, first];
}

/** `[INDEX] { extrapolate IN OUT keys k { … } }` */
function* channel(t: Tokens, sink: KeySink, index: number): GrammarPart<Channel> {
  yield* blockHead(t, 'channel', index, KEYWORDS);
  let extrapolation: readonly [Extrapolation, Extrapolation] | undefined;
  let keys: Keys | undefined;
  for (;;) {
    const kind = yield* t.next();
    if (kind === '}') break;
    if (kind === 'end') t.failAtEnd(undefined, `channel ${index}`);
    const word = t.keyword();
    if (word === 'extrapolate') {
      if (extrapolation) warnRepeated(t, word);
      const before = yield* extrapolate(t, 'before the first key');
      const after = before && (yield* extrapolate(t, 'after the last key'));
      extrapolation = [before ?? 'constant', after ?? 'constant'];
    } else if (word === 'keys') {
      if (keys) warnRepeated(t, word);
      keys = yield* keyRows(t, sink);
    } else if (word === 'channel' || word === 'numchannels' || word === 'range') {
      t.braceMissing(`channel ${index}`);
      break;
    } else yield* skipStrange(t, 'a channel', 'extrapolate or keys', IN_CHANNEL);
  }
  if (!keys) {
    t.warnOnce('keys-missing', '', () => 'Expected keys in a channel, found none.', 'the channel stays at 0');
  }
  if (!extrapolation) {
    const message = 'Expected extrapolate IN OUT in a channel, found none.';
    t.warnOnce('extrapolate-missing', '', () => message, 'used constant on both sides');
  }
  const [extrapolateIn, extrapolateOut] = extrapolation ?? ['constant', 'constant'];
  if (!keys?.times.length) return { ...restChannel(), extrapolateIn, extrapolateOut };
  return withAutoRecognised({ ...keys, kind: 'keys', extrapolateIn, extrapolateOut });
}

/** One extrapolation; undefined if the word is missing, which is reported. */
function* extrapolate(t: Tokens, side: string): GrammarPart<Extrapolation | undefined> {
  yield* t.next();
  const word = t.keyword();
  const known = EXTRAPOLATIONS.find((e) => e === word);
  if (known) return known;
  // If the file ends here, its missing brace is reported.
  if (t.kind !== 'end') {
    t.error('extrapolation-unknown', `Expected ${EXTRAPOLATIONS.join(', ')} ${side}, found ${t.found()}.`);
  }
  if (t.kind === 'word' && !KEYWORDS.has(word)) return 'constant';
  t.again();
  return undefined;
}

/** `k { time value tan_in tan_out … }` */
function* keyRows(t: Tokens, sink: KeySink): GrammarPart<Keys> {
  const declared = yield* countAndBrace(t, 'keys', KEYWORDS);
  sink.begin();
  yield* t.numbers(sink, 'keys', KEYWORDS);
  checkRows(t, 'keys', 4, declared, sink.found);
  return sink.columns(t);
}
