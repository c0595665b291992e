/** Takes as files of motion, for `marrow convert`. */
import { withEditedTakes } from '../../dataset/edited-take.ts';
import type { TakeOptions } from '../../dataset/take.ts';
import { CommandError } from '../../edit/command-error.ts';
import { writeExchange } from '../../export/exchange.ts';
import { EXCHANGE_FORMATS, type ExchangeFormat, isExchange } from '../../export/formats.ts';
import { DEFAULT_GLB } from '../../export/glb/options.ts';
import { TakeError } from '../../export/shared/take-motion.ts';
import { outputsOf, TARGETS, targetObstacle } from '../../files/save/conversion.ts';
import type { Character } from '../../model/document.ts';
import type { ExportedFile } from './formats.ts';

/** What takes are written as, one by one: `glb` and its like with all of the character. */
export const MOTION_KINDS = [...TARGETS, ...EXCHANGE_FORMATS] as const;
export type MotionKind = (typeof MOTION_KINDS)[number];

export function isMotion(to: string): to is MotionKind {
  return MOTION_KINDS.some((kind) => kind === to);
}

/** The files of the shown take: of `skel` the take comes after its skeleton. @throws CommandError */
export async function motionFiles(
  character: Character,
  to: MotionKind,
  { fps, tolerance, ...options }: TakeOptions & { readonly tolerance?: number },
): Promise<readonly ExportedFile[]> {
  const { takes, shownTake, parts, ...rest } = character;
  const own = { ...rest, takes: takes.slice(shownTake, shownTake + 1), shownTake: 0 };
  const edited = withEditedTakes(own, options);
  const asked = { ...(fps !== undefined && { framesPerSecond: fps }), ...(tolerance !== undefined && { tolerance }) };
  if (isExchange(to)) return [{ ending: to, pieces: await exchangePieces(to, edited, { ...DEFAULT_GLB, ...asked }) }];
  const why = targetObstacle(edited, to);
  if (why !== undefined) throw new CommandError(why);
  return outputsOf([edited], to, asked).map((output) => ({
    ending: output.name.slice(output.name.lastIndexOf('.') + 1),
    pieces: output.pieces(),
  }));
}

async function exchangePieces(format: ExchangeFormat, character: Character, options: typeof DEFAULT_GLB) {
  try {
    return (await writeExchange(format, character, options, true)).pieces;
  } catch (error) {
    if (!(error instanceof TakeError)) throw error;
    throw new CommandError(error.message);
  }
}
