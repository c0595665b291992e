/** What every command of rigging is given. */
import type { Character } from '../../../model/document.ts';
import type { RigSkin } from '../../state/posing.ts';
import type { Uses } from '../../state/workbench.ts';

/** The pose shown is what stays, in bind mode: stop what plays before. */
export function rigging(
  { posing, transport }: Uses<'transport' | 'posing'>,
  { id }: Pick<Character, 'id'>,
): { readonly characterId: string; readonly skin: RigSkin; readonly timeSeconds: number } {
  return { characterId: id, skin: posing.rigSkin.get(), timeSeconds: transport.get().timeSeconds };
}
