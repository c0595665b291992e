/** The section of a limb in the inspector: share of IK, switch and space of the limb that the selected joint belongs to. */
import type { GUI } from 'lil-gui';
import { keyLimb } from '../../../edit/commands/beside/limbs.ts';
import { limbRows } from '../../../evaluate/limbs/infos.ts';
import { jointReferences } from '../../../model/skeleton/joint-reference.ts';
import { PARENT_SPACE, WORLD_SPACE } from '../../../model/takes/goals.ts';
import { tryById } from '../../state/actions/action.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { followWithNumbers } from '../../state/follow-time.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Workbench } from '../../state/workbench.ts';
import { Slider } from '../../widgets/numbers/slider.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { putInSpace } from './edits.ts';
import { selectedLimbs } from './selected-limbs.ts';

export class LimbSection {
  private readonly blend: Slider;
  private readonly space: ReturnType<GUI['add']>;
  private readonly binding = { space: WORLD_SPACE, switch: () => {}, key: () => {} };
  private readonly switching: ReturnType<GUI['add']>;
  /** What the list of spaces is made of. */
  private spaces: string | undefined;

  constructor(
    private readonly wb: Workbench,
    private readonly section: GUI,
  ) {
    const edit = new HandEdit(wb.store, wb.messages);
    const options = { span: [0, 1], bounds: [0, 1], step: 0.01, decimals: 3 } as const;
    this.blend = new Slider(section, 'IK', 0, options, (reason) => wb.messages.note(reason, 'warning'));
    this.blend.onChange((blend: number) => {
      const of = this.limb();
      pausePlayback(wb);
      if (of) edit.preview(keyLimb, { ...of, blend });
    });
    this.blend.onTakenBack(() => edit.cancel()).onFinishChange(() => edit.commit());
    this.binding.switch = () => tryById(wb, 'limb.switch');
    this.binding.key = () => tryById(wb, 'limb.key');
    this.switching = section.add(this.binding, 'switch').name('Switch to IK');
    section.add(this.binding, 'key').name('Key goal');
    this.space = section.add(this.binding, 'space', [WORLD_SPACE]).name('Space');
    setTooltip(this.space.domElement, 'From the current time on, if the goal has keys; it stays where it is');
    this.space.onChange((space: string) => this.put(space));
    followWithNumbers(wb.transport, () => this.showNow());
  }

  /** Updates all values. */
  update(): void {
    const selected = selectedLimbs(this.wb);
    this.section.show(selected !== undefined);
    if (!selected) return;
    const { character, limbs } = selected;
    const names = limbs.map(({ limb }) => limb.name).join(', ');
    this.section.title(`Limb ${names}`);
    const { joints = [] } = character.skeleton ?? {};
    const own = new Set(limbs.flatMap(({ limb }) => limb.joints));
    const all = jointReferences(joints).filter((_, joint) => !own.has(joint) && !isBelow(joints, joint, own));
    const key = all.join('\n');
    if (key !== this.spaces) this.space.options([WORLD_SPACE, PARENT_SPACE, ...all]);
    this.spaces = key;
    this.showNow();
  }

  private showNow(): void {
    const selected = selectedLimbs(this.wb);
    if (!selected) return;
    const row = limbRows(selected.character, this.wb.transport.get().timeSeconds)[selected.limbs[0].index];
    const { blend = 0, space } = row;
    this.blend.showValue(blend);
    this.switching.name(blend >= 0.5 ? 'Switch to FK' : 'Switch to IK');
    this.space.enable(space !== undefined);
    this.binding.space = space ?? WORLD_SPACE;
    this.space.updateDisplay();
  }

  private put(space: string): void {
    const { document } = this.wb.store;
    putInSpace(this.wb, space);
    if (this.wb.store.document === document) this.showNow();
  }

  private limb() {
    const selected = selectedLimbs(this.wb);
    if (!selected) return undefined;
    const { timeSeconds, range } = this.wb.transport.get();
    return { characterId: selected.character.id, limb: selected.limbs[0].index, timeSeconds, playedRange: range };
  }
}

function isBelow(joints: readonly { readonly parent: number }[], joint: number, above: ReadonlySet<number>): boolean {
  for (let j = joint; j >= 0; j = joints[j].parent) if (above.has(j)) return true;
  return false;
}
