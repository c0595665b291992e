/** What keys and wheel do while an element has the focus; elsewhere the page has them. */

/** What they act on. */
export interface KeyTarget {
  toggle(): void;
  turn(azimuth: number, polar: number): void;
  /** The distance to what the camera looks at, times this. */
  approach(factor: number): void;
  /** All of it, from where the camera is. */
  frame(): void;
  step(frames: number): void;
}

const TURN = Math.PI / 24;
const CLOSER = 0.85;

const KEYS: Readonly<Record<string, (target: KeyTarget) => void>> = {
  ' ': (target) => target.toggle(),
  ArrowLeft: (target) => target.turn(-TURN, 0),
  ArrowRight: (target) => target.turn(TURN, 0),
  ArrowUp: (target) => target.turn(0, -TURN),
  ArrowDown: (target) => target.turn(0, TURN),
  '+': (target) => target.approach(CLOSER),
  '=': (target) => target.approach(CLOSER),
  '-': (target) => target.approach(1 / CLOSER),
  Home: (target) => target.frame(),
  ',': (target) => target.step(-1),
  '.': (target) => target.step(1),
};

/** Until the signal aborts. @param stage where keys turn the camera */
export function listenToKeys(stage: HTMLElement, target: KeyTarget, signal: AbortSignal): void {
  stage.addEventListener(
    'keydown',
    (event) => {
      const act = event.ctrlKey || event.metaKey || event.altKey ? undefined : KEYS[event.key];
      if (!act) return;
      event.preventDefault();
      act(target);
    },
    { signal },
  );
  // A page that is scrolled past an element isn't held up by it: the wheel is the page's until the element is used.
  stage.addEventListener(
    'wheel',
    (event) => {
      if (!stage.matches(':focus')) event.stopPropagation();
    },
    { capture: true, passive: true, signal },
  );
}
