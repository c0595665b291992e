/** What would fill an empty dope sheet. */
import { spanOfChannel } from '../../../model/clip.ts';
import { currentCharacter } from '../../state/action.ts';
import type { Workbench } from '../../state/workbench.ts';
import type { Take } from '../timeline/in-hand.ts';

export function emptyText(wb: Workbench, take: Take | undefined): string {
  if (!wb.store.document.characters.length)
    return 'Keys will stand here. Drop a character and its animation anywhere on the page.';
  const driven = take?.character.driver ?? currentCharacter(wb)?.driver;
  if (driven) return `Keys of its own stand aside. What moves it has its own: those of ${driven.source.name}.`;
  const keyed = take?.clip.channels.some((_, c) => spanOfChannel(take.clip, c)) ?? false;
  const { filter } = wb.timeline.view.get();
  if (take && filter.trim() && keyed) return `No row with keys is called “${filter.trim()}”.`;
  return 'Nothing is keyed yet. K keys the whole pose at the playhead, Shift+K the selected joint; or drop an .anim file.';
}
