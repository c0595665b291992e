/** Whole files of each kind of text file, for damage; poses are written from the wasp's skeleton. */

import { writePoses } from '../../src/formats/pose/write.ts';
import { readSkel } from '../../src/formats/skel/read.ts';
import { dofsOf } from '../../src/model/skeleton/joint-types.ts';
import { BVH_FILES } from '../helpers/bvh-files.ts';
import { OWN_CAPTURES } from '../helpers/own-files.ts';
import { hasShared, sharedBytes } from '../helpers/shared.ts';
import { fileBytes, GOOD_FILES } from './shared-files.ts';

export interface RealFile {
  readonly name: string;
  readonly text: string;
}

const decoded = (bytes: Uint8Array) => new TextDecoder().decode(bytes);
const named = (paths: readonly string[]) => paths.map((path) => ({ name: path, text: decoded(fileBytes(path)) }));
const kind = (extension: string) => GOOD_FILES.filter((path) => path.endsWith(`.${extension}`));

/** Files of each kind, by extension; kinds that none is here of are left out. */
export function realFiles(): ReadonlyMap<string, readonly RealFile[]> {
  const captures = [...OWN_CAPTURES].map(([name, bytes]) => ({ name, text: decoded(bytes) }));
  const all: readonly (readonly [string, readonly RealFile[]])[] = [
    ...['skel', 'skin', 'morph', 'anim', 'rig', 'axskel'].map(
      (extension) => [extension, named(kind(extension))] as const,
    ),
    ['bvh', [...captures, ...named(BVH_FILES.map((name) => `data/bvh/${name}`))]],
    ['pose', hasShared ? [{ name: 'wasp.pose', text: waspPoses() }] : []],
  ];
  return new Map(all.filter(([, files]) => files.length > 0));
}

function waspPoses(): string {
  const joints = readSkel(sharedBytes('data/cse169/wasp.skel'), 'wasp.skel').value?.[0].joints ?? [];
  const posed = (angle: number) =>
    joints.map(({ name, motion, pose }) => ({
      name,
      dofs: dofsOf(motion).map((dof, i) => ({ name: dof.name, value: pose[i] + angle })),
    }));
  const weights = [{ name: 'smile', value: 0.25 }];
  return writePoses([
    { name: 'rest', root: [0, 0, 0], joints: posed(0), weights },
    { name: 'wings up', root: [0, 1, 0.5], joints: posed(0.125), weights },
  ]).text;
}
