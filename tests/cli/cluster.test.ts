/** The recipes of `docs/guide/datasets.md`, run with programs that stand for those of a cluster. */
import { execFileSync } from 'node:child_process';
import { chmodSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { delimiter, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';
import { command } from '../helpers/command.ts';

const RECIPES = readFileSync(fileURLToPath(new URL('../../docs/guide/datasets.md', import.meta.url)), 'utf8');
const TAKE = `HIERARCHY ROOT Hips { OFFSET 0 0 0 CHANNELS 3 Xposition Yposition Zposition } MOTION
Frames: 2
Frame Time: 0.1
0 1 0
0 1 1
`;

/** The script that begins with this line. */
function script(firstLine: string): string {
  const found = RECIPES.split('```').find((block) => block.replace(/^\w+\n/, '').startsWith(firstLine));
  if (!found) throw new Error(`docs/guide/datasets.md has no script that begins with ${firstLine}`);
  return found.slice(found.indexOf('\n') + 1);
}

it('each task of the Slurm array exports its part, and the last one joins the manifests', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'marrow-cluster-'));
  try {
    for (const name of ['bin', 'job', 'job/takes']) mkdirSync(join(folder, name));
    for (let i = 0; i < 5; i++) writeFileSync(join(folder, `job/takes/take${i}.bvh`), TAKE);
    const programs = {
      srun: '#!/bin/bash\nexec "$@"\n',
      // What it is called with is run in this process, since starting another takes long.
      marrow: '#!/bin/bash\nprintf "%s\\0" "$PWD" "$@"\n',
      'job.sh': script('#!/bin/bash'),
    };
    for (const [name, text] of Object.entries(programs)) {
      writeFileSync(join(folder, 'bin', name), text);
      chmodSync(join(folder, 'bin', name), 0o755);
    }
    for (const task of ['2', '3', '1']) {
      const called = execFileSync(join(folder, 'bin/job.sh'), {
        cwd: folder,
        encoding: 'utf8',
        env: {
          PATH: `${join(folder, 'bin')}${delimiter}${process.env.PATH}`,
          SLURM_SUBMIT_DIR: join(folder, 'job'),
          SLURM_ARRAY_TASK_ID: task,
          SLURM_ARRAY_TASK_COUNT: '3',
          SLURM_CPUS_PER_TASK: '4',
        },
      });
      const [where, ...args] = called.split('\0').slice(0, -1);
      expect(args.join(' ')).toBe(`export takes/ --to npz --out dataset/ --shard ${task}/3 --jobs 4 --resume`);
      expect(await command(args, where)).toMatchObject({ code: 0, err: '' });
    }
    expect(readdirSync(join(folder, 'job/dataset')).sort()).toEqual([
      ...[1, 2, 3].map((part) => `manifest.${part}-of-3.ndjson`),
      'manifest.ndjson',
      ...[0, 1, 2, 3, 4].map((i) => `take${i}.npz`),
    ]);
    expect(readFileSync(join(folder, 'job/dataset/manifest.ndjson'), 'utf8').trimEnd().split('\n')).toHaveLength(5);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
