/** Reads `.npy` and `.npz` files by what they hold: the first kind of arrays that fits. */
import { capturesOfFrames } from '../../evaluate/captured-frames.ts';
import { pointCapture } from '../../evaluate/point-capture.ts';
import { metresPerUnit, statedSpace } from '../../evaluate/space/metres.ts';
import { upText } from '../../evaluate/space/space.ts';
import { guessSharedSpace } from '../../evaluate/space/space-guess.ts';
import { stemOfName } from '../../formats/grammar.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Capture } from '../../model/files.ts';
import type { FileSpace } from '../../model/space.ts';
import { Budget, mostNumbers } from '../budget.ts';
import { type Import, ImportError, Remarks } from '../imported.ts';
import type { ArraysKind, ReadMotion } from './kind.ts';
import { fail, shapeText } from './npy.ts';
import { Arrays } from './npz.ts';
import { OWN } from './own.ts';
import { HUMANML3D, POSITIONS } from './positions.ts';
import { isShapeAlone, SMPL } from './smpl.ts';

const KINDS: readonly ArraysKind[] = [OWN, SMPL, POSITIONS, HUMANML3D];

/**
 * Numbers of any file: three quarters of an hour of SMPL-H at 60 frames a second. Motion is packed to a tenth at best; only
 * values that never change take so little more that this counts.
 */
const BASE = 24e6;

function tooPacked(bytes: number, most: number): string {
  return `The arrays that are needed have more than ${Math.floor(most / 1e6)} million numbers, packed into ${bytes} bytes: constant values can be packed like that, motion can't. If it is right, save them without compression (numpy.savez).`;
}

/** Captures with the space that they share. */
export interface ReadCaptures {
  readonly captures: readonly Capture[];
  readonly space: FileSpace;
}

/** The captures of a file; absent if it has errors, or no motion by its kind. Never throws for anything that the file holds. */
export function readNumpy({ fileName, bytes }: Pick<Import, 'fileName' | 'bytes'>): {
  readonly value?: ReadCaptures;
  readonly diagnostics: readonly Diagnostic[];
} {
  const remarks = new Remarks(fileName);
  try {
    const most = mostNumbers(bytes.length, BASE);
    const budget = new Budget(bytes.length, () => fail('numpy-packed', tooPacked(bytes.length, most)), most);
    const arrays = new Arrays(bytes, fileName, budget);
    if (!kindOf(arrays) && isShapeAlone(arrays)) {
      const message = 'It has the shape of a body (betas) without motion, as AMASS keeps one beside its takes.';
      remarks.warn('format-unknown', message, 'skipped');
      return { diagnostics: remarks.finish() };
    }
    const value = capturesIn(arrays, fileName, remarks);
    return { value, diagnostics: remarks.finish() };
  } catch (error) {
    if (!(error instanceof ImportError)) throw error;
    return { diagnostics: [...remarks.finish(), remarks.error(error)] };
  }
}

function kindOf(arrays: Arrays): ArraysKind | undefined {
  return KINDS.find((kind) => kind.is(arrays));
}

function capturesIn(arrays: Arrays, fileName: string, remarks: Remarks): ReadCaptures {
  const kind = kindOf(arrays);
  if (!kind) {
    // One that can't be read says why.
    if (arrays.names.length === 1) arrays.array(arrays.names[0]);
    return fail('arrays-unknown', unknown(arrays));
  }
  const motion = kind.read(arrays, remarks);
  const name = stemOfName(fileName);
  const captures =
    'points' in motion ? [pointCapture(name, motion.points)] : capturesOfFrames(name, motion.joints, motion.frames);
  motion.told?.();
  return { captures, space: spaceOf(captures, motion, remarks) };
}

/** Names of this many arrays are told. */
const MAX_TOLD = 20;

function unknown(arrays: Arrays): string {
  const told = arrays.names.slice(0, MAX_TOLD).map((name) => {
    const header = arrays.header(name);
    return header
      ? `${name} ${shapeText(header)}${header.type === 'O' ? ' of Python objects' : ''}`
      : `${name} (not readable)`;
  });
  const more = arrays.names.length - told.length;
  const found = told.length > 0 ? `${told.join(', ')}${more > 0 ? ` and ${more} more` : ''}` : 'no arrays';
  return `Found ${found}. Expected ${KINDS.map(({ says }) => says).join('; ')}.`;
}

/** As the file states it; what it doesn't is guessed, and said. */
function spaceOf(captures: readonly Capture[], { space, up, isDown }: ReadMotion, remarks: Remarks): FileSpace {
  if (space) return space;
  const guessed = guessSharedSpace(captures, isDown ? '-y' : undefined);
  const metres = metresPerUnit(guessed.space);
  if (!up) {
    const used = `used ${metres} m per unit, ${upText(guessed.space)}`;
    remarks.tell('unit-guessed', 'The file states neither its unit nor its up axis.', used);
    return guessed;
  }
  // The ground alone is guessed, in metres as the file has it.
  const lift = guessed.space.up === up ? Number((guessed.space.lift / metres).toFixed(3)) : 0;
  const stated = statedSpace(1);
  return { ...stated, space: { ...stated.space, up, lift } };
}
