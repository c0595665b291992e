/**
 * Writes points as OpenSim's `.trc`: a head of five lines, then a row for each frame, between tabs. Where a point is
 * missing, its three cells are empty. In pieces, as `.bvh` is.
 */

import type { Diagnostic } from '../../model/diagnostic.ts';
import type { PointsFile } from '../../model/files.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import type { LengthUnit } from '../../model/space.ts';
import { columnOf } from '../../model/takes/samples.ts';
import { USUAL_FRAMES_PER_SECOND } from '../../model/takes/take.ts';
import type { WrittenPieces } from '../reader.ts';
import { Text } from '../write-text.ts';

/** Rows per piece. */
const ROWS = 64;
/** Digits of a frame rate, of which takes have the inverse. */
const RATE_DIGITS = 12;
/** Numbers of a point: x y z, and whether it is there. */
const WIDTH = 4;

/** As OpenSim writes them; of others the file says nothing. */
const UNITS: { readonly [U in LengthUnit]?: string } = {
  metres: 'm',
  decimetres: 'dm',
  centimetres: 'cm',
  millimetres: 'mm',
  inches: 'in',
};

/**
 * Writes a capture of points, whose DOFs are sampled or, without a take, those of its pose.
 * @param fileName in the head, and in diagnostics
 */
export function writeTrc({ capture, space }: PointsFile, fileName = ''): WrittenPieces {
  const text = new Text(fileName);
  const { skeleton, take } = capture;
  const { samples } = take ?? {};
  const { joints } = skeleton;
  const frameSeconds = samples?.frameSeconds ?? 1 / USUAL_FRAMES_PER_SECOND;
  const frameCount = samples?.frameCount ?? 1;
  const rate = text.number(Number((1 / frameSeconds).toPrecision(RATE_DIGITS)));
  const unit = (space && UNITS[space.space.unit]) ?? '';
  text.line(0, `PathFileType\t4\t(X/Y/Z)\t${fileName}`);
  text.line(0, 'DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames');
  text.line(0, [rate, rate, frameCount, joints.length, unit, rate, 1, frameCount].join('\t'));
  text.line(0, `Frame#\tTime\t${joints.map(({ name }, p) => `${labelOf(text, name, p)}\t\t`).join('\t')}`);
  text.line(0, `\t\t${joints.map((_, p) => ['X', 'Y', 'Z'].map((axis) => `${axis}${p + 1}`).join('\t')).join('\t')}`);
  text.line(0, '');
  const first = samples ? columnOf(samples, firstDofs(skeleton)[0]) : 0;
  const values = samples?.values ?? Float64Array.from(joints.flatMap(({ pose }) => pose));
  const width = samples?.scales.length ?? WIDTH * joints.length;
  let diagnostics: readonly Diagnostic[] = [];
  function* pieces() {
    for (let frame = 0; frame < frameCount; frame++) {
      text.line(0, rowOf(text, frame, frame * frameSeconds, values, first + frame * width, joints.length));
      if (frame % ROWS === 0) yield UTF8.encode(text.takeText());
    }
    const rest = text.result();
    yield UTF8.encode(rest.text);
    diagnostics = rest.diagnostics;
  }
  return { pieces: pieces(), diagnostics: () => diagnostics };
}

const UTF8 = new TextEncoder();
/** Of seconds, which are only told. */
const TIME_DECIMALS = 6;

function rowOf(
  text: Text,
  frame: number,
  seconds: number,
  values: Float64Array,
  from: number,
  pointCount: number,
): string {
  let row = `${frame + 1}\t${Number(seconds.toFixed(TIME_DECIMALS))}`;
  for (let p = 0, at = from; p < pointCount; p++, at += WIDTH) {
    if (values[at + 3] < 1) row += '\t\t\t';
    else for (let k = 0; k < 3; k++) row += `\t${text.number(values[at + k])}`;
  }
  return row;
}

/** A label may have blanks. */
function labelOf(text: Text, name: string, p: number): string {
  return name === '' ? `point${p + 1}` : text.lineName(name.replaceAll('\t', ' '), 'label').slice(1);
}
