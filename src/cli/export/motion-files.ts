/** Takes as files of motion, for `marrow convert`. */
import { withEditedTakes } from '../../dataset/edited-take.ts';
import type { TakeOptions } from '../../dataset/take.ts';
import type { Character } from '../../model/document.ts';
import { outputsOf, TARGETS, type Target } from '../../project/save/conversion.ts';
import type { ExportedFile } from './formats.ts';

export function isMotion(to: string): to is Target {
  return TARGETS.some((target) => target === to);
}

/** The files of the shown take: of `skel` the take comes after its skeleton. @throws CommandError */
export function motionFiles(
  character: Character,
  to: Target,
  { fps, tolerance, ...options }: TakeOptions & { readonly tolerance?: number },
): readonly ExportedFile[] {
  const { clips, shownClip, parts, ...rest } = character;
  const own = { ...rest, clips: clips.slice(shownClip, shownClip + 1), shownClip: 0 };
  const edited = withEditedTakes(own, options);
  const made = outputsOf([edited], to, {
    ...(fps !== undefined && { framesPerSecond: fps }),
    ...(tolerance !== undefined && { tolerance }),
  });
  return made.map((output) => ({
    ending: output.name.slice(output.name.lastIndexOf('.') + 1),
    pieces: output.pieces(),
  }));
}
