/** FBX files that are damaged, hostile, or none. */
import { zlibSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { bone, CUBIC_USER, errorOf, meshFile, read, sceneOf, turning, zCurve } from './small-files.ts';
import { walkingBones } from './walking-bones.ts';
import { type Connection, curve, type Fbx, fbxBytes, fbxText, type Obj, prop, rec, recordBytes } from './write-fbx.ts';

describe('files that are no FBX 7', () => {
  it('other files are refused by what they are', () => {
    expect(errorOf('')).toMatch(/empty/);
    expect(errorOf('solid cube')).toMatch(/Expected an FBX file/);
    expect(errorOf('; FBX 6.1.0 project file\n')).toMatch(/version 6\.1.*Converter/);
    expect(errorOf(recordBytes(6100, []))).toMatch(/version 6\.1/);
  });

  it('a text that breaks off or has no number says where', () => {
    const text = fbxText(turning([{ time: 0, value: 0, flags: 4 }]));
    const { diagnostics } = read(text.slice(0, text.indexOf('Connections') - 3));
    expect(diagnostics[0].message).toMatch(/Expected \}/);
    const broken = read(text.replace('a: 0', 'a: zero'));
    expect(broken.diagnostics[0].message).toMatch(/Expected a number/);
    expect(broken.diagnostics[0].line).toBeGreaterThan(10);
  });

  it('a binary file that breaks off says at which byte', () => {
    const bytes = fbxBytes(turning([{ time: 0, value: 0, flags: 4 }]));
    expect(errorOf(bytes.slice(0, bytes.length / 2))).toMatch(/cut off.*at byte \d+/);
  });

  it('an array that unpacks to more than it says, or says more than deflate holds, is refused', () => {
    const bomb = zlibSync(new Uint8Array(5_000_000));
    const array = (count: number) => {
      const header = Buffer.alloc(13);
      header.write('d');
      header.writeUInt32LE(count, 1);
      header.writeUInt32LE(1, 5);
      header.writeUInt32LE(bomb.length, 9);
      return Buffer.concat([header, bomb]);
    };
    for (const count of [10, 100_000_000]) {
      const file = recordBytes(7400, [rec('Objects', [Float64Array.of(1)])]);
      const at = Buffer.from(file).indexOf('Objects') + 7;
      const value = array(count);
      const body = Buffer.concat([Buffer.from(file.slice(0, at)), value, Buffer.alloc(13)]);
      body.writeUInt32LE(at + value.length, 27);
      body.writeUInt32LE(value.length, 35);
      expect(errorOf(new Uint8Array(body))).toMatch(/compressed array is damaged/);
    }
  });

  it('small files that ask for much are refused by their size', () => {
    const packed = (count: number) => rec('Vertices', [new Float64Array(count)]);
    expect(errorOf(fbxBytes({ ...meshFile([packed(5e6)]) }))).toMatch(/needs more than 4\d* numbers in memory/);
    const points = Array.from({ length: 3000 }, (_, i) => i % 7);
    const mesh = meshFile([], { points, corners: Array.from({ length: 999 }, (_, i) => (i % 3 === 2 ? ~i : i)) });
    const copies = Array.from(
      { length: 900 },
      (_, i): Obj => ({ id: 1000 + i, kind: 'Model', name: '', type: 'Mesh' }),
    );
    const connections = copies.flatMap(({ id }): Connection[] => [
      [id, 0],
      [11, id],
    ]);
    const many = { objects: [...mesh.objects, ...copies], connections: [...mesh.connections, ...connections] };
    expect(errorOf(fbxBytes(many))).toMatch(/A mesh needs more than/);
  });

  it('a curve that repeats for hours gets no more keys than its file is worth, which is said', () => {
    const keys = [
      { time: 0, value: 0, flags: CUBIC_USER, data: [9e4, 0, 0, 0] as const },
      { time: 0.001, value: 99, flags: CUBIC_USER, data: [1e5, 1e5, 0, 0] as const },
    ];
    const fbx = turning(keys, prop('PreRotation', 20, 30, 0), prop('PostRotation', 5, 0, 0));
    const cycle = rec('Post-Extrapolation', [], [rec('Type', [{ int: 82 }]), rec('Repetition', [{ int: -1 }])]);
    const objects = fbx.objects.map((own) => (own.id === 4 ? curve(4, keys, [cycle]) : own));
    const { value, diagnostics } = read(fbxBytes({ ...fbx, objects }));
    expect(diagnostics.map(({ code }) => code)).toContain('curves-too-long');
    expect(value && zCurve(value).times.length).toBeLessThan(50_000);
  });

  it('models that are each other’s parents are left out', () => {
    const fbx: Fbx = {
      objects: [bone(10, 'a'), bone(11, 'b'), bone(12, 'c')],
      connections: [
        [10, 11],
        [11, 10],
        [12, 0],
      ],
    };
    expect(sceneOf(fbx).nodes.map(({ name }) => name)).toEqual(['c']);
    expect(
      errorOf(
        fbxBytes({
          ...fbx,
          connections: [
            [10, 11],
            [11, 10],
          ],
        }),
      ),
    ).toMatch(/Expected models/);
  });

  it('thousands of models inside each other are no harm: those too deep are left out, and said', () => {
    const objects = Array.from({ length: 3000 }, (_, i) => bone(10 + i, `b${i}`, prop('InheritType', { int: 0 })));
    const connections = objects.map(({ id }, i): Connection => [id, i === 0 ? 0 : id - 1]);
    const { value, diagnostics } = read(fbxBytes({ objects, connections }));
    expect(value?.nodes.length).toBe(500);
    expect(diagnostics.map(({ message }) => message).join()).toMatch(
      /2500 models outside the scene or nested too deeply/,
    );
  });

  it('an encrypted file says so', () => {
    expect(errorOf(recordBytes(7400, [rec('EncryptionType', ['x']), rec('Objects')]))).toMatch(/password-protected/);
  });
});

it('what is told of a binary file as a whole, or of a byte of it, has no line', () => {
  const { diagnostics } = read(fbxBytes(walkingBones));
  expect(diagnostics.map(({ code, line }) => [code, line])).toContainEqual(['fbx-space', 0]);
  expect(diagnostics.filter(({ line }) => line > 0)).toEqual([]);
});
