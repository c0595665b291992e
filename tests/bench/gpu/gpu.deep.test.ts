import { execPath } from 'node:process';
import { describe, expect, it } from 'vitest';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { parse } from '../../../src/worker/parse.ts';
import { isSoftware } from './drawing.ts';
import { optionsOf } from './options.ts';
import { queryOf, viewOf } from './peer/scene.ts';
import { FULL, SMALL, scenesOf } from './scenes/scenes.ts';
import { INFLUENCES, tentacle } from './scenes/tentacle.ts';
import { ratio, tableOf } from './table.ts';

const opened = async (name: string, sizes = SMALL) => {
  const scene = scenesOf(sizes).find((one) => one.name === name);
  const files = await parse({ files: scene?.files?.() ?? [] }, () => undefined);
  return { scene, ...openFiles(EMPTY_DOCUMENT, files.files), read: files.diagnostics };
};

describe('scenes on a GPU', () => {
  it.each(['walkers', 'captures', 'morphs', 'star'])(
    '%s open without a complaint, as many as they say',
    async (name) => {
      const { scene, document, diagnostics, read } = await opened(name);
      expect([...read, ...diagnostics].filter(({ severity }) => severity !== 'info')).toEqual([]);
      expect(document.characters.length).toBe(scene?.characters);
      for (const { takes } of document.characters) expect(takes.length).toBe(1);
    },
  );

  it('a star and a tentacle have the joints, vertices and morphs that are asked for', async () => {
    const [star] = (await opened('star')).document.characters;
    expect(star.skeleton?.joints.length).toBe(SMALL.starJoints);
    const [character] = (await opened('morphs')).document.characters;
    expect([character.skins[0].positions.length / 3, character.morphs.length]).toEqual([SMALL.vertices, 3]);
  });

  it('the tentacle has the vertices that are asked for, weights of 1, and normals that point outwards', () => {
    expect(FULL.vertices).toBe(1_000_000);
    // As many around as of the full size.
    const { positions, weights, triangles, normals } = tentacle(FULL.vertices / 10);
    expect([positions.length / 3, triangles.length / 3]).toEqual([100_000, 199_000]);
    for (const v of [0, 49_999, 99_999]) {
      const own = weights.subarray(INFLUENCES * v, INFLUENCES * (v + 1));
      expect(own.reduce((sum, weight) => sum + weight, 0)).toBeCloseTo(1, 6);
    }
    const [a, b, c] = Array.from(triangles.subarray(0, 3), (v) => positions.subarray(3 * v, 3 * v + 3));
    const [p, q] = [b, c].map((end) => end.map((x, k) => x - a[k]));
    const outwards = (p[1] * q[2] - p[2] * q[1]) * normals[0] + (p[0] * q[1] - p[1] * q[0]) * normals[2];
    expect(outwards).toBeGreaterThan(0);
  });
});

describe('the options of frames on a GPU', () => {
  it('choose scenes in the order of the table, and seconds', () => {
    const options = optionsOf(['--scenes', 'star,walkers', '--seconds', '0.5', '--headed', '--flag=--use-angle=gl']);
    expect(options).toMatchObject({ scenes: ['walkers', 'star'], seconds: 0.5, headed: true, shadow: true });
    expect(options).toMatchObject({ flags: ['--use-angle=gl'], chromium: undefined });
    expect(optionsOf(['--chromium', execPath, '--no-shadow'])).toMatchObject({ chromium: execPath, shadow: false });
  });

  it('name all scenes where they are asked for', () => {
    expect(optionsOf(['--help'])).toEqual({
      usage: expect.stringMatching(/--scenes A,B +some of walker, /),
      isWrong: false,
    });
  });

  it.each([
    [['--scenes', 'walker,crowd'], 'There is no scene "crowd".'],
    [['--seconds', 'ten'], '--seconds must be greater than 0, found ten.'],
    [['--chromium', 'gone/chrome'], '--chromium: there is no file gone/chrome.'],
    [['--fast'], "Unknown option '--fast'"],
  ] as const)('that are wrong are told in a sentence above the usage: %j', (args, sentence) => {
    const wrong = optionsOf(args);
    expect(wrong).toMatchObject({ isWrong: true, usage: expect.stringMatching(/\nUsage: npm run bench -- gpu/) });
    expect('usage' in wrong && wrong.usage.startsWith(sentence)).toBe(true);
  });
});

describe('the table of frames', () => {
  const frames = (...whole: number[]) => ({ whole, script: whole.map(() => 1) });

  it('has medians, 95th percentiles and ratios with and without the floor, and a dash for what is not there', () => {
    const rows = [
      { label: 'a', page: frames(...Array(18).fill(13), 30, 40), peer: frames(12, 12, 12), openingMs: 1234 },
      { label: 'b', page: frames(20) },
      { label: 'c' },
    ];
    const lines = tableOf(rows, frames(10, 10, 90)).split('\n');
    const cells = lines.map((line) =>
      line
        .split('|')
        .slice(1, -1)
        .map((cell) => cell.trim()),
    );
    expect(cells.slice(2)).toEqual([
      ['a', '13.0 (30.0)', '1.0 (1.0)', '12.0 (12.0)', '1.0 (1.0)', '1.08 ×', '1.50 ×', '1.23 s'],
      ['b', '20.0 (20.0)', '1.0 (1.0)', '–', '–', '–', '–', '–'],
      ['c', '–', '–', '–', '–', '–', '–', '–'],
      ['nothing: the floor', '–', '–', '10.0 (90.0)', '1.0 (1.0)', '–', '–', '–'],
    ]);
    expect(new Set(lines.map((line) => line.length)).size).toBe(1);
  });

  it('has no ratio to what is no slower than nothing', () => {
    expect(ratio([12], [10.05], 10)).toBeUndefined();
    expect(ratio([12], [11], 10)).toBe(2);
  });
});

it('renderers of the processor are known by their names, and GPUs are none', () => {
  const processors = [
    'ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader driver)',
    'ANGLE (Mesa, llvmpipe (LLVM 15.0.7, 256 bits), OpenGL 4.5)',
    'ANGLE (Microsoft, Microsoft Basic Render Driver Direct3D11 vs_5_0 ps_5_0)',
  ];
  const gpus = [
    'ANGLE (NVIDIA, Vulkan 1.3.277 (NVIDIA H100), NVIDIA)',
    'ANGLE (Apple, ANGLE Metal Renderer: Apple M2, Unspecified Version)',
    'ANGLE (Intel, Mesa Intel(R) UHD Graphics 620 (KBL GT2), OpenGL 4.6)',
  ];
  expect([...processors, ...gpus].map(isSoftware)).toEqual([true, true, true, false, false, false]);
});

it('the page of three.js alone reads from its query what it was given', () => {
  const view = { scene: { kind: 'walkers', count: 100 }, shadow: true, size: { width: 981, height: 790 } } as const;
  expect(viewOf(queryOf(view))).toEqual(view);
});
