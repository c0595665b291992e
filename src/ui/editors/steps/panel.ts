/**
 * *Steps*: how the numbers of the selected joint or vertex come about, from the file to where it is drawn. The slider
 * beside the tabs applies the steps one after another in the viewport; nothing in the document changes.
 */

import type { Character } from '../../../model/document.ts';
import { shownSkin } from '../../../model/document.ts';
import { vertexCount } from '../../../model/skin.ts';
import { inFilePose } from '../../../teaching/program/file-pose.ts';
import { stepsOfPose } from '../../../teaching/steps/dof-steps.ts';
import { PinOverlay } from '../../../view/pins/pin-overlay.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { takeTimeShown } from '../../state/dump-times.ts';
import { followWithNumbers } from '../../state/follow-time.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { FormulaView } from './formula-view.ts';
import { jointView } from './joint-view.ts';
import { paintStage } from './paint-stage.ts';
import type { Stages } from './stages.ts';
import { vertexView } from './vertex-view.ts';
import type { StepsView } from './view.ts';

const NOTHING = 'Select a joint, or a vertex of the skin, to see how its numbers are computed, step by step.';

type Parts = Uses<'store' | 'viewport' | 'transport' | 'posing' | 'timeline'>;

export function stepsPanel(wb: Parts): TimelineTab {
  return new StepsPanel(wb);
}

class StepsPanel implements TimelineTab {
  readonly element = element('div', { class: 'steps', 'data-panel': 'steps', tabindex: -1 });
  readonly tools: HTMLElement;
  private readonly empty = element('p', { class: 'empty' }, NOTHING);
  private readonly slider = element('input', { type: 'range', class: 'steps-slider', min: 0, max: 0, step: 1 });
  private readonly label = element('output', { class: 'steps-stage' });
  private readonly filePose: HTMLButtonElement;
  private readonly formulas: FormulaView;
  private visible = false;
  private key: readonly unknown[] = [];
  private character: Character | undefined;
  private view: StepsView | undefined;
  private stages: Stages | undefined;
  private removeOverlay: (() => void) | undefined;
  private readonly showSoon = oncePerFrame(() => this.show());

  constructor(private readonly wb: Parts) {
    this.formulas = new FormulaView(wb);
    this.element.append(this.empty);
    setAttribute(this.slider, 'aria-label', 'Steps applied in the viewport');
    this.slider.addEventListener('input', () => {
      this.showStage();
      this.cardNow()?.scrollIntoView({ block: 'nearest', inline: 'nearest' });
    });
    const { stepsOfFile } = wb.timeline;
    this.filePose = button(
      'File pose',
      { class: 'tool text-tool', tooltip: 'Steps of the file pose, without the take' },
      'File pose',
      () => stepsOfFile.update((is) => !is),
    );
    stepsOfFile.subscribe(() => this.showSoon());
    this.tools = element('div', { class: 'steps-tools' }, this.filePose, this.slider, this.label);
    wb.store.subscribe(() => this.showSoon());
    wb.transport.subscribe((now, before) => {
      if (now.timeSeconds !== before.timeSeconds || now.playing !== before.playing) this.showSoon();
    });
    followWithNumbers(wb.transport, () => {
      // At rest they are filled with all else.
      if (this.visible && wb.transport.get().playing) this.view?.fill();
    });
  }

  setVisible(visible: boolean): void {
    if (visible === this.visible) return;
    this.visible = visible;
    this.formulas.lightNothing();
    if (visible) this.showSoon();
    this.showOverlay();
  }

  fitAll(): void {
    this.element.scrollTo({ left: 0, top: 0 });
  }

  fitSelected(): void {
    this.cardNow()?.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }

  recolour(): void {
    // The styles do.
  }

  private show(): void {
    if (!this.visible) return;
    const { wb } = this;
    this.build();
    const { view, character } = this;
    if (!view || !character) return;
    const { transport, timeline } = wb;
    // Without a take it is shown anyway.
    const isMoved = takeTimeShown(wb, character) !== undefined;
    const isOfFile = isMoved && timeline.stepsOfFile.get();
    write(this.filePose, 'hidden', !isMoved);
    setAttribute(this.filePose, 'aria-pressed', String(isOfFile));
    this.stages = view.follow(
      isOfFile ? stepsOfPose(inFilePose(character), 0) : stepsOfPose(character, transport.get().timeSeconds),
    );
    if (!transport.get().playing) view.fill();
    this.showStage();
  }

  /** Another joint or vertex, or other parts of the character, have other cards. */
  private build(): void {
    const { wb } = this;
    const { characterId, joint, vertex } = wb.store.selection;
    const character = currentCharacter(wb);
    const own = character?.id === characterId;
    const skin = character && shownSkin(character);
    const key = [character?.id, own && joint, own && vertex, character?.skeleton, skin, character?.morphs];
    this.character = character;
    if (key.every((part, i) => part === this.key[i]) && key.length === this.key.length) return;
    this.key = key;
    this.formulas.lightNothing();
    this.view = character && own ? this.viewOf(character, joint, vertex) : undefined;
    this.stages = undefined;
    this.element.replaceChildren(this.view?.element ?? this.empty);
    const last = (this.view?.cards.length ?? 1) - 1;
    this.slider.max = String(last);
    this.slider.value = String(last);
    write(this.tools, 'hidden', !this.view);
    this.showOverlay();
  }

  private viewOf(character: Character, joint: number | undefined, vertex: number | undefined): StepsView | undefined {
    const skin = shownSkin(character);
    if (skin && vertex !== undefined && vertex < vertexCount(skin)) {
      return vertexView(this.formulas, character, skin, vertex);
    }
    return joint === undefined ? undefined : jointView(this.formulas, character, joint);
  }

  private get stage(): number {
    return Number(this.slider.value);
  }

  private cardNow(): HTMLElement | undefined {
    return this.view?.cards[this.stage];
  }

  private showStage(): void {
    const { view, stages, stage } = this;
    const labels = stages?.labels ?? [];
    const text = labels[stage] ?? '';
    setText(this.label, labels.length > 1 ? `${stage} of ${labels.length - 1}: ${text}` : text);
    setAttribute(this.slider, 'aria-valuetext', text);
    const now = this.cardNow();
    for (const card of view?.cards ?? []) card.classList.toggle('now', card === now);
    this.wb.viewport.requestRender();
  }

  private showOverlay(): void {
    const isNeeded = this.visible && this.view !== undefined;
    if (isNeeded === (this.removeOverlay !== undefined)) return;
    if (isNeeded) this.removeOverlay = this.wb.viewport.addOverlay(new PinOverlay((painter) => this.paint(painter)));
    else {
      this.removeOverlay?.();
      this.removeOverlay = undefined;
    }
  }

  private paint(painter: Parameters<ConstructorParameters<typeof PinOverlay>[0]>[0]): void {
    const { stages, character, wb } = this;
    if (!stages || !character) return;
    const placement = wb.viewport.placementOf(character.id, wb.viewport.pickedCopy(character));
    if (placement) paintStage(painter, stages, this.stage, placement, (at) => wb.viewport.eye.unitsPerPixel(at));
  }
}
