/** What the `meta` of an exported take says: where it comes from, and what was done to it. */
import type { ArrayTake } from '../../dataset/take.ts';
import { metresPerUnit } from '../../evaluate/space/metres.ts';
import type { Character } from '../../model/document.ts';
import { VERSION } from '../../model/version.ts';
import type { Meta } from './formats.ts';
import type { ExportSettings } from './settings.ts';
import type { TakeInput } from './take-inputs.ts';

/** Changes when the same input and options give other numbers. */
export const LAYOUT = 3;

/** Where a take comes from. */
export interface TakeSource {
  /** As it was read. */
  readonly source: Character;
  readonly input: TakeInput;
  readonly hash: string;
  /** What its file doesn't state, and was assumed. */
  readonly notes: readonly string[];
}

/** The metadata of a take's arrays. */
export function metaOf(
  { source, input, hash, notes }: TakeSource,
  { character, space, skeleton }: ArrayTake,
  { fps, crop, isRaw, isMirrored, rate, retarget, map }: ExportSettings,
): Meta {
  const { space: read } = character;
  return {
    program: 'marrow',
    version: VERSION,
    layout: LAYOUT,
    input: input.path,
    hash,
    ...(input.skeleton && { skeleton: input.skeleton.path }),
    take: source.takes[source.shownTake]?.name ?? source.name,
    character: skeleton.name,
    // Null: those of the file.
    unit: space ? 'metre' : null,
    up: space ? 'y' : null,
    quaternions: 'x y z w',
    // How numbers of the file became those of the arrays, or how they would have.
    ...(read && {
      file: { up: read.up, metresPerUnit: metresPerUnit(read), lift: read.lift, known: read.known },
    }),
    raw: isRaw ?? false,
    mirror: isMirrored ?? false,
    ...(notes.length > 0 && { notes }),
    ...(rate !== undefined && { rate }),
    ...(fps !== undefined && { fps }),
    ...(crop && { crop: [crop.from ?? null, crop.to ?? null] }),
    ...(retarget !== undefined && {
      retarget: { to: retarget.length === 1 ? retarget[0] : retarget, ...(map !== undefined && { map }) },
    }),
  };
}
