/**
 * Curves in JSON: a number, which is constant, or keys as `.anim` has them, each a row of time, value and the tangents
 * on both sides, in words or as slopes.
 *
 *     0.5
 *     { "extrapolate": ["constant", "cycle"], "keys": [[0, 1, "flat", "flat"], [0.5, 0, -2, "linear"]] }
 */
import type { OtherFields } from '../../model/other-fields.ts';
import { autoNumber, withAutoRecognised } from '../../model/takes/auto-slope.ts';
import { EXTRAPOLATIONS, type Extrapolation, type KeyedChannel, type Tangents } from '../../model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT, TANGENT_KINDS, TANGENTS } from '../../model/takes/tangent-kinds.ts';
import { WHOLE_FILE } from '../places.ts';
import type { Report } from '../report.ts';
import type { JsonValue } from './read.ts';

/** A curve of a file, with the fields of its object that are not known. */
export interface JsonCurve {
  /** A constant value, too, if it has no keys: 0. */
  readonly curve: number | KeyedChannel;
  readonly others?: OtherFields;
}

/** A curve as a channel, or its constant value. */
export function readCurve(value: JsonValue, report: Report): JsonCurve {
  if (!value.isObject()) return { curve: value.number('a number, or an object with keys') };
  const object = value.object();
  const sides = object.optional('extrapolate')?.list();
  if (sides && sides.length !== 2) object.field('extrapolate').wrong('two words');
  const [extrapolateIn, extrapolateOut] = sides?.map(extrapolation) ?? CONSTANT;
  const rows = object.field('keys').list().map(keyRow);
  const others = object.others();
  if (rows.length === 0) return { curve: 0, ...others };
  if (rows.some(({ time }, k) => k > 0 && time < rows[k - 1].time)) {
    report.warn('keys-unsorted', `${value.path}.keys are out of order in time.`, WHOLE_FILE, 'sorted');
    rows.sort((a, b) => a.time - b.time);
  }
  const side = (which: 'in' | 'out'): Tangents => ({
    kinds: Uint8Array.from(rows, (row) => row[which].kind),
    slopes: Float64Array.from(rows, (row) => row[which].slope),
  });
  const curve = withAutoRecognised({
    ...{ kind: 'keys', extrapolateIn, extrapolateOut },
    times: Float64Array.from(rows, ({ time }) => time),
    values: Float64Array.from(rows, (row) => row.value),
    tangentsIn: side('in'),
    tangentsOut: side('out'),
  });
  return { curve, ...others };
}

const CONSTANT: readonly Extrapolation[] = ['constant', 'constant'];

function extrapolation(value: JsonValue): Extrapolation {
  return value.word(EXTRAPOLATIONS);
}

function keyRow(value: JsonValue) {
  const row = value.list();
  if (row.length !== 4) value.wrong('a row of time, value and two tangents');
  const [time, number, before, after] = row;
  return { time: time.number(), value: number.number(), in: tangentOf(before), out: tangentOf(after) };
}

const WORDS = TANGENTS.filter(({ isWord }) => isWord).map(({ name }) => name);

function tangentOf(value: JsonValue): { readonly kind: number; readonly slope: number } {
  if (!value.isText()) return { kind: FIXED_TANGENT, slope: value.number(`${WORDS.join(', ')} or a slope`) };
  return { kind: TANGENT_KINDS.indexOf(value.word(WORDS)), slope: 0 };
}

/** The curve as JSON has it. */
export function curveValue({ curve, others }: JsonCurve): unknown {
  if (typeof curve === 'number') return curve;
  const { times, values, tangentsIn, tangentsOut, extrapolateIn, extrapolateOut } = curve;
  const tangent = ({ kinds, slopes }: Tangents, k: number) => {
    if (kinds[k] === AUTO_TANGENT) return autoNumber(curve, k, slopes[k]);
    return kinds[k] === FIXED_TANGENT ? slopes[k] : TANGENT_KINDS[kinds[k]];
  };
  return {
    extrapolate: [extrapolateIn, extrapolateOut],
    keys: Array.from(times, (time, k) => [time, values[k], tangent(tangentsIn, k), tangent(tangentsOut, k)]),
    ...others,
  };
}
