/** Files of Acclaim: fetched when there are any. A motion is read with the skeleton that its name belongs to. */

import { metresPerUnit, statedSpace } from '../evaluate/space/metres.ts';
import { guessedHeight, guessSpace } from '../evaluate/space/space-guess.ts';
import { readAmc } from '../formats/acclaim/read-amc.ts';
import { asfReader } from '../formats/acclaim/read-asf.ts';
import { stemOfName } from '../formats/grammar.ts';
import { NO_PLACE } from '../formats/places.ts';
import { readWhole } from '../formats/reader.ts';
import { ParseError, Report } from '../formats/report.ts';
import type { Import } from '../import/imported.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../model/diagnostic.ts';
import type { ContentOf } from '../model/files.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { FileSpace } from '../model/space.ts';
import type { Take } from '../model/takes/take.ts';
import { skeletonNameFor } from './acclaim-names.ts';
import type { ImportedFile } from './imports.ts';

/** Reads a `.asf`. Never throws for anything that the file holds. */
export function readAcclaimSkeleton({ fileName, bytes }: Import): ImportedFile<ContentOf<'asf'>> {
  const { value: skeleton, diagnostics } = readWhole(asfReader(fileName), bytes);
  if (!skeleton) return { diagnostics, beside: [] };
  return { value: { kind: 'asf', skeleton, space: spaceOf(skeleton, undefined) }, diagnostics, beside: [] };
}

/** Reads an `.amc` with the skeleton that its name belongs to. Never throws for anything that the file holds. */
export async function readAcclaimTake(given: Import): Promise<ImportedFile<ContentOf<'amc'>>> {
  const { fileName, bytes, beside, near } = given;
  const names = near?.('asf') ?? [];
  const name = skeletonNameFor(fileName, names);
  const found = name === undefined ? undefined : await beside(name);
  if (!found) {
    const others =
      names.length > 0
        ? `others: ${names.slice(0, 3).join(', ')}${names.length > 3 ? ' and more' : ''}. Name it after one of them.`
        : 'none. Open both.';
    const message = `Expected its skeleton, an .asf file of the same name or its beginning, found ${others}`;
    return { diagnostics: [withoutPlace('error', 'skeleton-missing', message, fileName)], beside: [], isWaiting: true };
  }
  const of = readWhole(asfReader(found.source.name), found.bytes);
  if (!of.value) {
    const message = `Its skeleton, ${found.source.name}, has errors.`;
    return { diagnostics: [withoutPlace('error', 'skeleton-broken', message, fileName)], beside: [], isWaiting: true };
  }
  const report = new Report(fileName);
  // One that is not named after the skeleton may be of another.
  const isOther = skeletonNameFor(fileName, [found.source.name, NOBODYS]) === undefined;
  if (isOther) {
    report.info(
      'skeleton-assumed',
      'Its name begins with that of no .asf file here.',
      NO_PLACE,
      `used ${found.source.name}, the only one`,
    );
  }
  const take = amcTake(bytes, report, stemOfName(fileName), of.value);
  const space = take && spaceOf(of.value, take);
  if (space?.space.known === 'guessed') {
    const message = 'The unit that the skeleton states would make a person less than 0.4 m or more than 3 m tall.';
    report.info('unit-guessed', message, NO_PLACE, `used ${metresPerUnit(space.space)} m per unit`);
  }
  const diagnostics: readonly Diagnostic[] = report.finish();
  if (!take || hasErrors(diagnostics)) {
    // That other one may come later.
    return { diagnostics, beside: [], ...(isOther && { isWaiting: true }) };
  }
  const value = { kind: 'amc', skeleton: of.value, take, of: found.source, ...(space && { space }) } as const;
  return { value, diagnostics, beside: [] };
}

/** Undefined, with errors in the report, if it is none. @param name of the take */
function amcTake(bytes: Uint8Array, report: Report, name: string, skeleton: Skeleton): Take | undefined {
  try {
    return readAmc(bytes, report, name, skeleton);
  } catch (error) {
    if (error instanceof ParseError) return undefined;
    throw error;
  }
}

/** The name of no skeleton: beside it, no other is the only one. */
const NOBODYS = ':.asf';
const INCH = 0.0254;
/** Metres; what is smaller or larger states another unit than it has. */
const [SMALLEST, TALLEST] = [0.4, 3];

/** The unit that the file states, y up, on the ground; guessed where it makes a person of an impossible size. */
function spaceOf(skeleton: Skeleton, take: Take | undefined): FileSpace {
  const stated = statedSpace(INCH / (skeleton.acclaim?.length ?? 1));
  const metres = metresPerUnit(stated.space);
  const { height, isPerson } = guessedHeight(skeleton, take, 'y');
  const guessed = guessSpace(skeleton, take);
  const tall = height * metres;
  if (isPerson && !(tall >= SMALLEST && tall <= TALLEST)) return { space: { ...guessed, up: 'y' }, standing: 0 };
  const lift = Number(((guessed.lift * metres) / metresPerUnit(guessed)).toFixed(3));
  return { ...stated, space: { ...stated.space, lift: guessed.up === 'y' ? lift : 0 } };
}
