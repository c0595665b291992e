import type { GivenBlob } from '../../src/worker/protocol.ts';

const textFile = (path: string, text: string): GivenBlob => ({ path, blob: new Blob([text]) });

/** A skin on one joint, and morphs of all of its vertices with a take that moves their weights. */
export function manyMorphs(vertices: number, morphs: number): GivenBlob[] {
  const rows = (at: (v: number) => string) => Array.from({ length: vertices }, (_, v) => at(v)).join('\n');
  const point = (v: number, lift: number) =>
    `${Math.cos(v).toFixed(4)} ${(v / vertices + lift).toFixed(4)} ${Math.sin(v).toFixed(4)}`;
  const skin = `positions ${vertices} {\n${rows((v) => point(v, 0))}\n}
normals ${vertices} {\n${rows(() => '0 1 0')}\n}
skinweights ${vertices} {\n${rows(() => '1 0 1')}\n}
triangles ${vertices - 2} {\n${Array.from({ length: vertices - 2 }, (_, v) => `${v} ${v + 1} ${v + 2}`).join('\n')}\n}
bindings 1 {\nmatrix {\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n}\n}\n`;
  const channel = (high: number) =>
    `channel { extrapolate cycle cycle keys 2 { 0 0 linear linear 1 ${high} linear linear } }`;
  const channels = [...Array(6).fill(channel(0)), ...Array(morphs).fill(channel(1))];
  return [
    textFile('ball.skel', 'balljoint root { boxmin -1 0 -1 boxmax 1 1 1 }'),
    textFile('ball.skin', skin),
    ...Array.from({ length: morphs }, (_, m) =>
      textFile(`ball_${m}.morph`, `positions ${vertices} {\n${rows((v) => `${v} ${point(v, m / 10)}`)}\n}`),
    ),
    textFile('ball.anim', `animation { range 0 1 numchannels ${channels.length}\n${channels.join('\n')}\n}`),
  ];
}
