/** `marrow grade`: a class of small submissions. The threads are tested with the built command. */
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { strToU8, zipSync } from 'fflate';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { Grade } from '../../src/cli/grade/grade.ts';
import { ODD_AMC, ODD_ASF } from '../helpers/acclaim.ts';
import { type CommandResult, command, commandJson, type PoseJson } from '../helpers/command.ts';

const SKEL = `balljoint root { offset 1 0 0 pose 0.2 0.3 0.5
  balljoint arm { offset 0 2 0 pose 0.25 -0.4 0.1
    balljoint hand { offset 0 1 0 pose 0.5 0.1 -0.3 } } }
`;
const SKIN = `positions 4 { 0 3 0 1 3 0 0 1 1 0.5 2 0.5 }
normals 4 { 0 0 1 0 1 0 1 0 0 0 0 1 }
skinweights 4 { 1 1 1 2 0 0.5 1 0.5 1 0 1 2 1 0.25 2 0.75 }
triangles 1 { 0 1 2 }
bindings 3 { matrix { 1 0 0 0 1 0 0 0 1 1 0 0 } matrix { 1 0 0 0 1 0 0 0 1 1 2 0 } matrix { 1 0 0 0 1 0 0 0 1 1 3 0 } }
`;
const anim = (second: number) => `animation { range 0 2 numchannels 12
${Array.from({ length: 12 }, (_, c) => `channel { extrapolate cycle bounce keys 3 { 0 ${0.1 * c} smooth smooth ${second} 0.5 smooth smooth 2 0.2 linear linear } }`).join('\n')} }
`;
const BVH = `HIERARCHY
ROOT hip { OFFSET 0 1 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
JOINT knee { OFFSET 0 -1 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 -1 0 } } }
MOTION
Frames: 2
Frame Time: 0.5
0 1 0 10 20 30 5 6 7
0 2 0 15 25 35 5 6 8
`;
const AXIS = '1 0 0 1 30 1\n2 1 0 0 -20 0\n';

let folder = '';
const write = (name: string, text: string) => {
  mkdirSync(dirname(join(folder, name)), { recursive: true });
  writeFileSync(join(folder, name), text);
};
const handIn = (path: string, { skel = SKEL, skin = SKIN, anim: take = anim(1) } = {}) => {
  write(`${path}/test.skel`, skel);
  write(`${path}/test.skin`, skin);
  write(`${path}/test.anim`, take);
};
const NASTY = 'O\'Neil, <i>"&amp;';

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-'));
  handIn('ref');
  handIn('class/ann');
  write('class/ann/main.cpp', 'int main() { return 0; }');
  write('class/ann/readme.txt', 'I used 2 late days.\n');
  handIn('class/bob/hw/project2', { skel: SKEL.replace('offset 0 2 0', 'offset 0 2.5 0') });
  handIn('class/cid', { skel: SKEL.replace('0 2 0', '0 two 0') });
  handIn('class/dan', { anim: anim(1.5) });
  handIn('class/eve', { skel: SKEL.replace('balljoint hand', 'balljoint thumb { } balljoint hand') });
  write('class/fay/notes.md', 'nothing');
  handIn(`class/${NASTY}`, { skel: 'balljoint root { <script>alert(1)</script>' });
  const { out } = await command(
    ['pose', 'ref/test.skel', 'ref/test.skin', 'ref/test.anim', '--time', '0.7', '--json'],
    folder,
  );
  const { joints } = (JSON.parse(out) as PoseJson).characters[0];
  write('class/gus/joints@0.7.txt', joints.map(({ world }) => world.join(' ')).join('\n'));
  write('class/hal/joints@0.7.txt', joints.map(({ local }) => local?.join(' ')).join('\n'));
  write('class/ida/test.skin', SKIN.replace('0 3 0', '0 3.5 0'));
  write('class/kim.txt', 'Kim handed in late.');
  write('class/.DS_Store', 'x');
  write('class/__MACOSX/._test.skel', 'x');
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const GRADE = ['grade', 'class', '--reference', 'ref'];
/** Each way to call it once: the class stays as it is. */
const printed = new Map<string, Promise<CommandResult>>();
const graded = (...args: string[]) => {
  const key = args.join(' ');
  const known = printed.get(key) ?? command([...GRADE, ...args], folder);
  printed.set(key, known);
  return known;
};
const gradedJson = async (...args: string[]) => {
  const { code, out } = await graded(...args, '--json');
  expect(code).toBe(1);
  // The command's documented shape; tests check what they read of it.
  return JSON.parse(out) as { readonly submissions: readonly Grade[]; readonly skipped: readonly string[] };
};
const grades = async (...args: string[]) => (await gradedJson(...args)).submissions;
const gradeOf = async (name: string) => {
  const found = (await grades()).find((grade) => grade.name === name);
  if (!found) throw new Error(`There is no submission ${name}.`);
  return found;
};

describe('marrow grade', () => {
  it('judges every submission, by its name', async () => {
    const found = await grades();
    expect(found.map(({ name, verdict }) => [name, verdict])).toEqual([
      ['ann', 'right'],
      ['bob', 'wrong'],
      ['cid', 'not judged'],
      ['dan', 'wrong'],
      ['eve', 'wrong'],
      ['fay', 'not judged'],
      ['gus', 'right'],
      ['hal', 'wrong'],
      ['ida', 'wrong'],
      [NASTY, 'not judged'],
    ]);
  });

  it('counts joints, errors and channels of files by what they evaluate to', async () => {
    const ann = await gradeOf('ann');
    expect(ann).toMatchObject({
      loads: true,
      joints: 3,
      jointError: 0,
      vertexError: 0,
      channels: { right: 12, of: 12 },
    });
    expect(ann.problems.filter(({ severity }) => severity !== 'info')).toEqual([]);
    const bob = await gradeOf('bob');
    expect(bob.parts[0]).toMatchObject({ own: ['arm'], first: { what: 'joint', index: 1, name: 'arm' } });
    expect(bob.parts[0].files).toContain('class/bob/hw/project2/test.skel');
    // Of lengths over the size of the character.
    expect(bob.jointError).toBeGreaterThan(0.05);
    const dan = await gradeOf('dan');
    expect(dan.channels?.right).toBeLessThan(12);
    expect(dan.channels?.of).toBe(12);
  });

  it('says where a file is broken, and what is missing', async () => {
    const cid = await gradeOf('cid');
    expect(cid.loads).toBe(false);
    expect(cid.problems).toContainEqual(
      expect.objectContaining({ file: 'class/cid/test.skel', line: 2, severity: 'error' }),
    );
    expect((await gradeOf('fay')).problems).toMatchObject([{ code: 'nothing-to-judge', file: 'class/fay' }]);
    expect((await gradeOf('eve')).parts[0].mismatches).toEqual(['4 joints, expected 3']);
  });

  it('compares dumps with the reference, with their cause', async () => {
    expect((await gradeOf('gus')).parts[0]).toMatchObject({ files: ['class/gus/joints@0.7.txt'], agrees: true });
    const [part] = (await gradeOf('hal')).parts;
    expect(part).toMatchObject({ agrees: false, causes: [{ code: 'no-parent', explains: 3, of: 3 }] });
  });

  it("completes a submission with the reference's own files", async () => {
    const ida = await gradeOf('ida');
    expect(ida).toMatchObject({ jointError: 0, channels: { right: 12, of: 12 } });
    expect(ida.parts[0]).toMatchObject({ files: ['class/ida/test.skin'], first: { what: 'vertex', index: 0 } });
  });

  it('takes the tolerance and the times as given', async () => {
    expect((await grades('--tolerance', '2')).find(({ name }) => name === 'bob')?.verdict).toBe('right');
    // At the first key nothing of it is seen.
    expect((await grades('--times', '0')).find(({ name }) => name === 'dan')?.verdict).toBe('right');
  });

  it.each([
    ['motion capture', 'walk.bvh', BVH, BVH.replace('10 20 30', '10 21 30')],
    ['axis-angle skeletons', 'arm.axskel', AXIS, AXIS.replace('-20', '-25')],
  ])('judges %s', async (_, name, right, wrong) => {
    write(`mocap-${name}/ref/${name}`, right);
    write(`mocap-${name}/class/a/${name}`, right);
    write(`mocap-${name}/class/b/${name}`, wrong);
    const args = ['grade', `mocap-${name}/class`, '--reference', `mocap-${name}/ref`];
    const { submissions } = await commandJson<{ submissions: readonly Grade[] }>(args, folder);
    expect(submissions.map(({ verdict }) => verdict)).toEqual(['right', 'wrong']);
  });

  it('prints a line each, with paths and lines of problems', async () => {
    const { out, code } = await graded();
    expect(code).toBe(1);
    const lines = out.split('\n');
    expect(lines.find((line) => line.startsWith('cid'))).toMatch(/not judged {2}no .* class\/cid\/test\.skel:2:\d+ /);
    expect(lines.find((line) => line.startsWith('hal'))).toMatch(/joint 1 "arm" at 0\.7 s +no-parent/);
    expect(out).toContain('10 submissions: 2 right, 5 wrong, 3 not judged.');
  });

  it('prints CSV that a spreadsheet reads, whatever the names', async () => {
    write('odd/=1+1/test.skel', SKEL);
    const { out } = await graded('--csv');
    expect(out).toContain(`"O'Neil, <i>""&amp;",not judged,no,`);
    expect(out.split('\r\n')).toHaveLength(12);
    expect((await command(['grade', 'odd', '--reference', 'ref', '--csv'], folder)).out).toContain("\r\n'=1+1,right,");
  });

  it('prints HTML with a page each, every name escaped, and nothing from outside', async () => {
    const { out } = await graded('--html');
    expect(out.match(/<section id=/g)).toHaveLength(10);
    expect(out).toContain('O&#39;Neil, &lt;i&gt;&quot;&amp;amp;');
    expect(out).not.toContain('<i>');
    expect(out).not.toContain('<script');
    expect(out).not.toMatch(/(?:src|href)="(?!#)/);
    expect(out).toContain('class/cid/test.skel:2:');
    expect(out).toContain('<dd>3 world matrices, 4 vertices, 4 normals at 7 times; 12 channels</dd>');
    expect(out).toContain('<dd>3 world matrices at 0.7 s</dd>');
  });

  it('says which files of the class belong to nobody, on all ways', async () => {
    const { err } = await graded();
    expect(err).toContain('class/kim.txt warning file-loose: Expected a folder or a zip for each submission');
    expect(err).not.toContain('DS_Store');
    expect((await gradedJson()).skipped).toEqual(['class/kim.txt']);
    expect((await graded('--html')).out).toContain(
      '<code>class/kim.txt</code> is neither a folder nor a zip, and was skipped.',
    );
  });

  it('takes a dump without a time to be of the time asked for or of the file pose, as it fits, and says which', async () => {
    const dumped = async (...args: readonly string[]) => {
      const { out } = await command(
        ['pose', 'ref/test.skel', 'ref/test.skin', 'ref/test.anim', ...args, '--json'],
        folder,
      );
      return (JSON.parse(out) as PoseJson).characters[0].joints;
    };
    const text = (joints: PoseJson['characters'][0]['joints'], key: 'world' | 'local') =>
      joints.map((joint) => joint[key]?.join(' ')).join('\n');
    write('untimed/pose/joints.txt', text(await dumped(), 'world'));
    write('untimed/asked/joints.txt', text(await dumped('--time', '0.7'), 'world'));
    // Local matrices as world matrices.
    write('untimed/wrong/all.txt', text(await dumped(), 'local'));
    write('untimed/noise/all.txt', text(await dumped(), 'world').replaceAll('0.', '1.'));
    for (const [times, at] of [
      ['0.7', 0.7],
      ['0.2,0.7', 0.7],
    ] as const) {
      const args = ['grade', 'untimed', '--reference', 'ref', '--times', times];
      const { submissions } = await commandJson<{ submissions: readonly Grade[] }>(args, folder);
      expect(submissions.map(({ name, verdict, parts }) => [name, verdict, parts[0].frameTimes])).toEqual([
        ['asked', 'right', [at]],
        ['noise', 'wrong', [Number(times.split(',')[0])]],
        ['pose', 'right', [null]],
        ['wrong', 'wrong', [null]],
      ]);
      expect(submissions[3].parts[0].causes).toMatchObject([{ code: 'no-parent' }]);
      const { out } = await command(args, folder);
      expect(out).toMatch(/wrong .*joint 1 "arm" in the file pose +no-parent/);
    }
  });

  it('judges a dump by the character whose joints it names, although others fit it', async () => {
    const { out } = await command(['pose', 'ref/test.skel', '--json'], folder);
    const { joints } = (JSON.parse(out) as PoseJson).characters[0];
    const rows = joints.map(({ name, world = [] }) =>
      [`joint (${name}):`, ...[0, 4, 8, 12].map((o) => world.slice(o, o + 4).join(' '))].join('\n'),
    );
    write('several/class/a/mine.txt', rows.join('\n'));
    write('several/ref/one/arms.skel', SKEL);
    write(
      'several/ref/two/legs.skel',
      SKEL.replaceAll(/root|arm|hand/g, (name) => `${name}_2`),
    );
    write('several/ref/three/three.skel', 'balljoint lone { }');
    write(
      'several/ref/three/three.anim',
      anim(1)
        .replace('numchannels 12', 'numchannels 3')
        .replace(/(\n.*){9} \}$/, ' }'),
    );
    const args = ['grade', 'several/class', '--reference', 'several/ref'];
    const { submissions } = await commandJson<{ submissions: readonly Grade[] }>(args, folder);
    expect(submissions[0].parts[0]).toMatchObject({ agrees: true, compared: { world: 3, channels: 0 } });
  });

  it('names all mistakes that explain a dump equally', async () => {
    const twice = anim(1).replaceAll('cycle bounce', 'cycle constant');
    write('equal/ref/test.skel', SKEL);
    write('equal/ref/test.anim', twice);
    // The value of the first key before it, and those of the keys.
    const rows = [-3.3, -1.2, 0, 1, 2].map((time) =>
      [time, ...Array.from({ length: 12 }, (_, c) => (time <= 0 ? 0.1 * c : time < 2 ? 0.5 : 0.2))].join(' '),
    );
    write('equal/class/a/mine.csv', rows.join('\n'));
    const table = await command(['grade', 'equal/class', '--reference', 'equal/ref'], folder);
    expect(table.out).toMatch(
      /extrapolation-ignored \(before the first and after the last key\) or .*modulo-negative \(the value of the first key is held\)/,
    );
  });

  describe('a submission of which something is unread or missing', () => {
    const rows = (text = '0.5') => ['0', '1', '2'].map((time) => `${time} ${text} 1 2 3 4 5 6 7 8 9 10 11`).join('\n');
    const verdicts = async (name: string, ...args: string[]) => {
      const all = ['grade', `${name}/class`, '--reference', `${name}/ref`, ...args];
      const { submissions } = JSON.parse((await command([...all, '--json'], folder)).out) as {
        submissions: readonly Grade[];
      };
      const csv = (await command([...all, '--csv'], folder)).out.split('\r\n').slice(1, -1);
      const html = (await command([...all, '--html'], folder)).out;
      for (const [i, { name: own, verdict }] of submissions.entries()) {
        expect(csv[i].startsWith(`${own},${verdict},`)).toBe(true);
        expect(html).toContain(`${own} <span class="badge ${verdict.replace(' ', '-')}">${verdict}</span>`);
      }
      return Object.fromEntries(submissions.map(({ name: own, verdict }) => [own, verdict]));
    };

    it('is incomplete, never right; what is wrong stays wrong', async () => {
      handIn('part/ref');
      handIn('part/class/whole');
      handIn('part/class/broken-take', { anim: anim(1).replace('smooth', 'smoth') });
      handIn('part/class/broken-skin', { skin: SKIN.replace('0 3 0', '0 three 0') });
      handIn('part/class/numbers');
      write('part/class/numbers/curves.csv', rows('x'));
      handIn('part/class/notes');
      write('part/class/notes/notes.txt', 'Part 1 took 3 hours, part 2 took 4.\nI used 2 late days.\n');
      handIn('part/class/wrong', { skel: SKEL.replace('offset 0 2 0', 'offset 0 2.5 0') });
      write('part/class/wrong/curves.csv', rows('x'));
      expect(await verdicts('part')).toEqual({
        whole: 'right',
        'broken-take': 'incomplete',
        'broken-skin': 'incomplete',
        numbers: 'incomplete',
        notes: 'right',
        wrong: 'wrong',
      });
    });

    it('lacks the numbers that the reference has', async () => {
      write('lack/ref/frames.csv', rows());
      write('lack/ref/more.csv', rows('0.25'));
      for (const name of ['one', 'both']) write(`lack/class/${name}/frames.csv`, rows());
      write('lack/class/both/more.csv', rows('0.25'));
      expect(await verdicts('lack')).toEqual({ one: 'incomplete', both: 'right' });
      const { err, out } = await command(['grade', 'lack/class', '--reference', 'lack/ref'], folder);
      expect([err, out]).toEqual(['', expect.stringMatching(/lack\/class\/one dump-missing\n/)]);
    });

    it('lacks what --needs names: kinds of numbers, kinds of files, files', async () => {
      handIn('need/ref');
      handIn('need/class/files');
      write('need/class/numbers/joints@0.7.txt', readFileSync(join(folder, 'class/gus/joints@0.7.txt'), 'utf8'));
      expect(await verdicts('need')).toEqual({ files: 'right', numbers: 'right' });
      expect(await verdicts('need', '--needs', 'skel,anim')).toEqual({ files: 'right', numbers: 'incomplete' });
      expect(await verdicts('need', '--needs', 'joints@0.7.txt')).toEqual({ files: 'incomplete', numbers: 'right' });
      expect(await verdicts('need', '--needs', 'world, vertices')).toEqual({ files: 'right', numbers: 'incomplete' });
      const wrong = await command([...GRADE, '--needs', 'worlds'], folder);
      expect([wrong.code, wrong.err]).toEqual([2, expect.stringContaining('found "worlds"')]);
    });
  });

  it('its report has the numbers of the submission beside Marrow’s, and the cause as a sentence', async () => {
    const hal = await gradeOf('hal');
    expect(hal.parts[0].shown).toMatchObject({
      what: 'World matrix',
      yours: [[], [], []].map(() => expect.any(Array)),
    });
    const dan = await gradeOf('dan');
    expect(dan.parts[0].shown?.yours).not.toEqual(dan.parts[0].shown?.marrows);
    const { out } = await graded('--html');
    expect(out).toMatch(
      /First wrong: joint 1 &quot;arm&quot; at 0\.7 s\. You use local matrices as world matrices. Each should be multiplied /,
    );
  });

  it('its report describes what no mistake explains as compare does', async () => {
    const files = ['ref/test.skel', 'ref/test.skin', 'ref/test.anim'];
    const { out } = await command(['pose', ...files, '--time', '0.7', '--json'], folder);
    const { joints } = (JSON.parse(out) as PoseJson).characters[0];
    const moved = joints.map(({ world = [] }, j) => world.map((value, i) => (j > 0 && i === 12 ? value + 0.5 : value)));
    write('unknown/ann/moved.txt', `time 0.7\n${moved.map((world) => world.join(' ')).join('\n')}`);
    const args = ['grade', 'unknown', '--reference', 'ref'];
    const [{ parts }] = (await commandJson<{ submissions: readonly Grade[] }>([...args, '--json'], folder)).submissions;
    const [none, pattern] = parts[0].unexplained;
    expect(parts[0].causes).toEqual([]);
    expect([none, pattern]).toEqual([
      'No known mistake, alone or with another, explains these numbers.',
      expect.stringMatching(/^What differs: /),
    ]);
    const compared = await command(['compare', ...files, 'unknown/ann/moved.txt'], folder);
    const html = (await command([...args, '--html'], folder)).out;
    for (const sentence of parts[0].unexplained) {
      expect(compared.out).toContain(sentence);
      expect(html).toContain(`<p>${sentence.replaceAll('"', '&quot;')}</p>`);
    }
  });

  it('its help says what a submission is, explains every option, and has an example that runs', async () => {
    const { out } = await command(['grade', '--help'], folder);
    const usage = out.split('\n')[0];
    for (const [option] of usage.matchAll(/--[a-z]+/g))
      expect(out.split('\n').slice(2).join('\n')).toContain(`${option}`);
    expect(out).toContain('a submission is a folder or a zip');
    const [, example] = /\n {2}marrow (grade .*) > report\.html/.exec(out) ?? [];
    const args = example
      .replace(/\bclass\b/, 'class')
      .replace('solution', 'ref')
      .split(' ');
    expect((await command(args, folder)).out).toContain('<!doctype html>');
  });

  it('names the broken files of a reference before their problems', async () => {
    write('cracked/a/one.skel', 'balljoint {');
    write('cracked/b/two.skel', SKEL.replace('0 2 0', '0 two 0'));
    write('cracked/c/good.skel', SKEL);
    const { err } = await command(['grade', 'class', '--reference', 'cracked'], folder);
    expect(err.split('\n')[0]).toBe('Broken in cracked: cracked/a/one.skel, cracked/b/two.skel.');
    expect(err).toContain("marrow: The reference cracked has errors in 2 files and can't be used for grading.");
  });

  it('says that wrong usage is wrong', async () => {
    write('broken/test.skel', 'balljoint {');
    mkdirSync(join(folder, 'bare'), { recursive: true });
    for (const [args, message] of [
      [['grade', 'class'], '--reference is missing'],
      [['grade', '--reference', 'ref'], 'takes one folder'],
      [['grade', 'none', '--reference', 'ref'], 'There is no folder "none"'],
      [['grade', 'class', '--reference', 'none'], 'There is no folder or zip "none"'],
      [['grade', 'class', '--reference', 'broken'], 'broken/test.skel:1:'],
      [['grade', 'class', '--reference', 'bare'], 'has no skeleton'],
      [['grade', 'bare', '--reference', 'ref'], 'There are no folders or zips in "bare"'],
      [[...GRADE, '--csv', '--html'], 'Give only one of'],
      [[...GRADE, '--tolerance', '-1'], 'greater than 0'],
    ] as const) {
      const { code, err } = await command(args, folder);
      expect([code, err], args.join(' ')).toEqual([2, expect.stringContaining(message)]);
    }
  });
});

describe('zipped submissions', () => {
  const zip = (name: string, files: Record<string, string>) =>
    writeFileSync(
      join(folder, name),
      zipSync(Object.fromEntries(Object.entries(files).map(([path, text]) => [path, strToU8(text)]))),
    );
  const whole = (inside: string) => ({
    [`${inside}test.skel`]: SKEL,
    [`${inside}test.skin`]: SKIN,
    [`${inside}test.anim`]: anim(1),
  });
  const graded = async (name: string) => {
    const args = ['grade', name, '--reference', 'ref'];
    return (await commandJson<{ submissions: readonly Grade[] }>(args, folder, 1)).submissions;
  };

  it('are judged as folders are, whatever folder is inside, and broken ones stop no other', async () => {
    mkdirSync(join(folder, 'zips/platform_1'), { recursive: true });
    zip('zips/ann.zip', whole(''));
    zip('zips/bob.ZIP', { ...whole('Project 2 - final/src/'), 'Project 2 - final/src/main.cpp': 'int main() {}' });
    zip('zips/cid.zip', { ...whole('hw/'), 'hw/test.skel': SKEL.replace('0 2 0', '0 2.5 0') });
    zip('zips/dan.zip', { ...whole('hw\\'), '__MACOSX/hw/._test.skel': '?', '.git/test.skel': '?' });
    zip('zips/eve.zip', { 'hw/test.skel': SKEL.replace('0 2 0', '0 two 0') });
    zip('zips/fay.zip', { 'readme.txt': 'See the other archive.' });
    zip('zips/platform_1/handed in.zip', whole('gus/'));
    writeFileSync(join(folder, 'zips/hal.zip'), zipSync({ 'test.skel': strToU8(SKEL) }).slice(0, -10));
    writeFileSync(join(folder, 'zips/ida.zip'), '7z');
    const grades = await graded('zips');
    expect(grades.map(({ name, verdict }) => [name, verdict])).toEqual([
      ['ann.zip', 'right'],
      ['bob.ZIP', 'right'],
      ['cid.zip', 'wrong'],
      ['dan.zip', 'right'],
      ['eve.zip', 'not judged'],
      ['fay.zip', 'not judged'],
      ['hal.zip', 'not judged'],
      ['ida.zip', 'not judged'],
      ['platform_1', 'right'],
    ]);
    const [, bob, cid, , eve, , hal] = grades;
    expect(bob.parts[0].files).toContain('zips/bob.ZIP/Project 2 - final/src/test.skel');
    expect(cid.parts[0]).toMatchObject({ own: ['arm'] });
    expect(eve.problems[0]).toMatchObject({ file: 'zips/eve.zip/hw/test.skel', line: 2, severity: 'error' });
    expect(hal.problems).toMatchObject([{ code: 'zip-unreadable', file: 'zips/hal.zip', severity: 'error' }]);
    expect(grades[8].parts[0].files).toContain('zips/platform_1/handed in.zip/gus/test.skel');
  });

  it('a zip that would fill the memory is refused, also if it understates its size', async () => {
    mkdirSync(join(folder, 'bombs'), { recursive: true });
    const text = Array.from({ length: 1000 }, (_, i) => Math.sin(i)).join(' ');
    const zipped = zipSync({ 'test.skel': strToU8(text) });
    const stating = (bytes: number) => {
      const changed = zipped.slice();
      // In the central directory: 46 bytes and the name of the entry, and 22 of the end.
      const entry = zipped.length - 22 - 46 - 'test.skel'.length;
      new DataView(changed.buffer).setUint32(entry + 24, bytes, true);
      return changed;
    };
    writeFileSync(join(folder, 'bombs/large.zip'), stating(2 ** 28 + 1));
    writeFileSync(join(folder, 'bombs/lying.zip'), stating(0));
    const grades = await graded('bombs');
    expect(grades.map(({ problems: [problem] }) => problem.message)).toEqual([
      "The archive can't be unpacked: it would unpack to more than 268435456 bytes.",
      "The archive can't be unpacked: test.skel is larger packed than unpacked.",
    ]);
  });
});

describe('dumps that the reference has too', () => {
  const rows = (list: readonly (readonly number[])[]) => `${list.map((row) => row.join(' ')).join('\n')}\n`;
  const right = async (time: string) => {
    const args = ['pose', 'ref/test.skel', 'ref/test.skin', 'ref/test.anim', '--time', time, '--json'];
    const { joints } = (JSON.parse((await command(args, folder)).out) as PoseJson).characters[0];
    return { world: rows(joints.map(({ world }) => world)), local: rows(joints.map(({ local }) => local ?? [])) };
  };
  const graded = async (name: string, code: 0 | 1 = 0) => {
    const args = ['grade', `${name}/class`, '--reference', `${name}/ref`];
    return (await commandJson<{ submissions: readonly Grade[] }>(args, folder, code)).submissions;
  };

  it('their times and kinds are those of the reference’s dump, where theirs says nothing', async () => {
    const [early, late] = [await right('0.3'), await right('0.7')];
    handIn('times/ref');
    write('times/ref/joints.txt', `time 0.3\n${early.world}time 0.7\n${late.world}`);
    write('times/ref/locals.txt', `time 0.7\nlocal\n${late.local}`);
    write('times/class/ann/JOINTS.txt', `time 0.3\n${early.world}time 0.7\n${late.world}`);
    write('times/class/ann/locals.txt', late.local);
    write('times/class/bob/joints.json', JSON.stringify([]));
    write('times/class/cid/joints.txt', `time 0.7\n${late.world}`);
    write('times/class/dan/joints.txt', `time 0.3\n${early.local}time 0.7\n${late.local}`);
    write('times/class/eve/locals.txt', late.local);
    write('times/class/fay/locals.txt', '1 2 3\n4 5 6 7\n8 9 10 11 12 13 14\n');
    const grades = await graded('times', 1);
    const facts = grades.map(({ name, verdict, parts: [part] }) => [
      name,
      verdict,
      part?.mismatches,
      part?.causes[0]?.code,
    ]);
    expect(facts).toEqual([
      ['ann', 'right', [], undefined],
      ['bob', 'not judged', undefined, undefined],
      ['cid', 'wrong', ['nothing at 0.3 s'], undefined],
      ['dan', 'wrong', [], 'no-parent'],
      // Without the joints.
      ['eve', 'incomplete', [], undefined],
      ['fay', 'wrong', ["numbers that differ from the reference's"], undefined],
    ]);
    expect(grades[1].problems[0]).toMatchObject({ code: 'dump-empty', file: 'times/class/bob/joints.json' });
    expect(grades[5].problems[0]).toMatchObject({ code: 'dump-length', file: 'times/class/fay/locals.txt', line: 1 });
  });

  it('numbers of no character are compared one by one, in either layout', async () => {
    const { world } = await right('0.7');
    const matrices = world
      .trim()
      .split('\n')
      .map((line) => line.split(' ').map(Number));
    const transposed = matrices.map((m) => m.map((_, i) => m[4 * (i % 4) + Math.floor(i / 4)]));
    write('numbers/ref/joints.txt', world);
    write('numbers/class/ann/joints.txt', rows(transposed));
    write('numbers/class/bob/joints.txt', rows(matrices.map((m, j) => (j === 1 ? m.with(13, 9) : m))));
    write('numbers/class/cid/joints.txt', rows(matrices.slice(1)));
    const grades = await graded('numbers');
    expect(grades.map(({ verdict, parts }) => [verdict, parts[0].numbers, parts[0].mismatches])).toEqual([
      ['right', 48, []],
      ['wrong', 48, [expect.stringMatching(/^line 2 has 9, expected -?\d/)]],
      ['wrong', 0, ['line 1 has 32 numbers, expected 48']],
    ]);
    const { out } = await command(['grade', 'numbers/class', '--reference', 'numbers/ref', '--html'], folder);
    expect(out).toContain('<dd>48 numbers, one by one</dd>');
  });

  it('a dump that contradicts the reference’s own files is told to the teacher, and compared one by one', async () => {
    const { world, local } = await right('0.7');
    handIn('contradicting/ref');
    write('contradicting/ref/joints.txt', `time 0.7\n${local}`);
    write('contradicting/class/ann/joints.txt', local);
    write('contradicting/class/bob/joints.txt', world);
    const args = ['grade', 'contradicting/class', '--reference', 'contradicting/ref', '--json'];
    const { out, err } = await command(args, folder);
    expect(err).toMatch(/contradicting\/ref\/joints\.txt warning reference-dump: .* off by \d/);
    const { submissions } = JSON.parse(out) as { submissions: readonly Grade[] };
    expect(submissions.map(({ verdict }) => verdict)).toEqual(['right', 'wrong']);
  });
});

describe('a class with files of Acclaim', () => {
  it('is judged by what they evaluate to, and by the numbers of its programs', async () => {
    const given = (path: string, amc = ODD_AMC) => {
      write(`${path}/x.asf`, ODD_ASF);
      write(`${path}/x_walk.amc`, amc);
    };
    given('acclaim-ref');
    given('acclaim/ann');
    given('acclaim/bob/hw', ODD_AMC.replace('low 0.2', 'low 0.7'));
    given('acclaim/cid', ODD_AMC.replace('low 0.2', 'lov 0.2'));
    // Read with the skeleton of the reference.
    write('acclaim/dot/x_walk.amc', ODD_AMC);
    write('acclaim/eve/x_walk.amc', ODD_AMC.replace('low 0.2', 'low 0.7'));
    const { submissions } = await commandJson<{ readonly submissions: readonly Grade[] }>(
      ['grade', 'acclaim', '--reference', 'acclaim-ref'],
      folder,
      1,
    );
    const [ann, bob, cid, dot, eve] = submissions;
    expect([ann.verdict, bob.verdict, cid.loads]).toEqual(['right', 'wrong', false]);
    expect(ann.joints).toBe(5);
    expect(bob.parts).toMatchObject([{ own: ['low'] }]);
    expect(cid.problems[0]).toMatchObject({ code: 'bone-unknown', line: 12 });
    expect([dot.verdict, dot.problems]).toEqual(['right', []]);
    expect([eve.verdict, eve.parts]).toMatchObject(['wrong', [{ own: ['low'] }]]);
  });
});
