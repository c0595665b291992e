/** Writes characters in formats of other programs, whose writers are fetched on first use. */
import type { Character } from '../model/document.ts';
import { bonesObstacle } from '../model/points.ts';
import type { ExchangeFormat } from './formats.ts';
import type { GlbOptions } from './glb/options.ts';
import type { ExchangeFile, ExchangeProgress } from './shared/report.ts';

/** A format, and which of the options count there. */
export interface Exchange {
  readonly mime: string;
  /** What it is for: a sentence. */
  readonly about: string;
  /** Options without meaning in it; `raw`: keeping the numbers of the file. */
  readonly ignores: readonly (keyof GlbOptions | 'raw')[];
}

/** By extension. */
export const EXCHANGES: Readonly<Record<ExchangeFormat, Exchange>> = {
  glb: {
    mime: 'model/gltf-binary',
    about: 'For Blender, game engines and the web: joints, skin, morphs, textures and takes.',
    ignores: [],
  },
  fbx: {
    mime: 'application/octet-stream',
    about: 'For Maya, MotionBuilder, Unity and Unreal: joints, skin, morphs, textures, and takes with their curves.',
    // Curves are kept, and bones show by themselves.
    ignores: ['keys', 'body'],
  },
  vrma: {
    mime: 'model/gltf-binary',
    about: 'For VRM players: the motion of a humanoid, which plays on any avatar.',
    ignores: ['keys', 'influences', 'body', 'raw'],
  },
};

/**
 * A character as a file of another program.
 * @param isPlaced whether it is where it is in the scene, upright and in metres, where a format has no unit and axes
 * @throws TakeError, in a sentence, if a take can't be written or isn't there
 */
export async function writeExchange(
  format: ExchangeFormat,
  character: Character,
  options: GlbOptions,
  isPlaced: boolean,
  onProgress?: (progress: ExchangeProgress) => void,
): Promise<ExchangeFile> {
  const why = bonesObstacle(character);
  if (why !== undefined) throw new (await import('./shared/take-motion.ts')).TakeError(why);
  if (format === 'fbx') return (await import('./fbx/write.ts')).writeFbx(character, options, onProgress);
  if (format === 'vrma') return (await import('./vrma/write.ts')).writeVrma(character, options, onProgress);
  return (await import('./glb/write.ts')).writeGlb(character, options, isPlaced, onProgress);
}
