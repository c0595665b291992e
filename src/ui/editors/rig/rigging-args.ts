/** Arguments shared by all rigging commands. */
import type { Character } from '../../../model/document.ts';
import type { RigSkin } from '../../state/posing.ts';
import type { Uses } from '../../state/workbench.ts';

/** In bind mode the current pose is kept: call after stopping playback. */
export function rigging(
  { posing, transport }: Uses<'transport' | 'posing'>,
  { id }: Pick<Character, 'id'>,
): { readonly characterId: string; readonly skin: RigSkin; readonly timeSeconds: number } {
  return { characterId: id, skin: posing.rigSkin.get(), timeSeconds: transport.get().timeSeconds };
}
