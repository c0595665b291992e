/** The tentacle as files of the page: `.skel`, `.skin`, three of `.morph`, and `.anim`. */
import type { GivenBlob } from '../../../../src/worker/protocol.ts';
import {
  angleOf,
  INFLUENCES,
  JOINT_LENGTH,
  JOINTS,
  KEYS,
  MORPHS,
  SECONDS,
  type TentacleMorph,
  tentacle,
  timeOf,
  weightOf,
} from './tentacle.ts';

/** @param vertices as for `tentacle` */
export function tentacleFiles(vertices: number): GivenBlob[] {
  const { positions, normals, joints, weights, triangles, morphs } = tentacle(vertices);
  const count = positions.length / 3;
  const influences = (v: number) =>
    Array.from({ length: INFLUENCES }, (_, i) => INFLUENCES * v + i).map(
      (at) => `${joints[at]} ${rounded(weights[at])}`,
    );
  const skin = [
    ...block('positions', count, (v) => triple(positions, v)),
    ...block('normals', count, (v) => triple(normals, v)),
    ...block('skinweights', count, (v) => `${INFLUENCES} ${influences(v).join(' ')}`),
    ...block('triangles', triangles.length / 3, (t) => triangles.subarray(3 * t, 3 * t + 3).join(' ')),
    ...block('bindings', JOINTS, (j) => `matrix { 1 0 0 0 1 0 0 0 1 0 ${rounded(j * JOINT_LENGTH)} 0 }`),
  ];
  return [
    { path: 'tentacle.skel', blob: new Blob([skel()]) },
    { path: 'tentacle.skin', blob: new Blob(skin) },
    ...morphs.map((morph, m) => ({ path: `tentacle_${m + 1}.morph`, blob: new Blob(morphText(morph)) })),
    { path: 'tentacle.anim', blob: new Blob([anim()]) },
  ];
}

/** Rows in each part of a text: a text of all of them would be too long a string. */
const ROWS = 10_000;

function* block(name: string, count: number, row: (index: number) => string): Generator<string> {
  yield `${name} ${count} {\n`;
  for (let from = 0; from < count; from += ROWS) {
    const rows = Array.from({ length: Math.min(ROWS, count - from) }, (_, i) => row(from + i));
    yield `${rows.join('\n')}\n`;
  }
  yield '}\n';
}

const rounded = (value: number) => String(Math.round(value * 1e6) / 1e6);
const triple = (values: Float32Array, at: number) => Array.from(values.subarray(3 * at, 3 * at + 3), rounded).join(' ');

function morphText({ vertices, positions }: TentacleMorph): string[] {
  return [...block('positions', vertices.length, (i) => `${vertices[i]} ${triple(positions, i)}`)];
}

function skel(): string {
  const joints = Array.from({ length: JOINTS }, (_, j) => {
    return `balljoint j${j} { offset 0 ${j === 0 ? 0 : JOINT_LENGTH} 0 boxmin -0.02 0 -0.02 boxmax 0.02 0.1 0.02\n`;
  });
  return joints.join('') + '}'.repeat(JOINTS);
}

/** Three channels of the root's position, three of each joint, and one of each morph. */
function anim(): string {
  const angles = Array.from({ length: 3 * JOINTS }, (_, c) => (key: number) => angleOf(Math.floor(c / 3), c % 3, key));
  const weights = Array.from({ length: MORPHS }, (_, m) => (key: number) => weightOf(m, key));
  const channels = [...Array.from({ length: 3 }, () => () => 0), ...angles, ...weights];
  const text = channels.map((valueAt) => {
    const keys = Array.from({ length: KEYS }, (_, k) => `${rounded(timeOf(k))} ${rounded(valueAt(k))} smooth smooth`);
    return `channel { extrapolate cycle cycle keys ${KEYS} {\n${keys.join('\n')}\n} }`;
  });
  return `animation { range 0 ${SECONDS} numchannels ${channels.length}\n${text.join('\n')}\n}\n`;
}
