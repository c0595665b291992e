/** What `convert` writes as GLB stands in metres with y up, wherever it is opened; `--raw` keeps the file's own space. */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { command } from '../helpers/command.ts';

/** A figure of 170 centimetres that stands along z. */
const STANDING = `HIERARCHY
ROOT hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT head
  {
    OFFSET 0 0 70
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 0 10
    }
  }
  JOINT foot
  {
    OFFSET 5 0 -90
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 10 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.033333
0 0 90 0 0 0 0 0 0 0 0 0
0 0 90 0 0 0 0 0 0 0 0 0
`;

interface Node {
  readonly name?: string;
  readonly children?: readonly number[];
  readonly translation?: readonly number[];
  readonly rotation?: readonly number[];
  readonly scale?: readonly number[];
}

let folder = '';
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-upright-'));
});
afterEach(() => rmSync(folder, { recursive: true, force: true }));

/** The nodes above the root's, and what the command said. */
async function converted(
  ...options: readonly string[]
): Promise<{ readonly above: readonly Node[]; readonly said: string }> {
  writeFileSync(join(folder, 'standing.bvh'), STANDING);
  const { code, err } = await command(['convert', 'standing.bvh', 'out.glb', ...options], folder);
  expect(code).toBe(0);
  const bytes = readFileSync(join(folder, 'out.glb'));
  const { nodes } = JSON.parse(bytes.toString('utf8', 20, 20 + bytes.readUInt32LE(12))) as { nodes: readonly Node[] };
  const above: Node[] = [];
  for (let at = nodes.findIndex(({ name }) => name === 'hips'); at >= 0; ) {
    at = nodes.findIndex(({ children }) => children?.includes(at) === true);
    if (at >= 0) above.push(nodes[at]);
  }
  return { above, said: err };
}

it('a capture in centimetres with z up stands in metres with y up, by a node above its joints, and the guess is said', async () => {
  const { above, said } = await converted();
  const placed = above.find(({ scale }) => scale !== undefined);
  for (const factor of placed?.scale ?? [0]) expect(factor).toBeCloseTo(0.01, 9);
  // A quarter turn about x takes z to y.
  const [x, y, z, w] = placed?.rotation ?? [0, 0, 0, 1];
  expect([x / w, y, z]).toEqual([expect.closeTo(-1, 9), expect.closeTo(0, 9), expect.closeTo(0, 9)]);
  expect(said).toMatch(/centimetres/);
});

it('--raw keeps its numbers: nothing above its joints moves them', async () => {
  const { above } = await converted('--raw');
  expect(above.filter(({ translation, rotation, scale }) => translation ?? rotation ?? scale)).toEqual([]);
});
