/** Tabs, as the keyboard expects them: one stop, arrow keys go from one to the next. */
import { element } from './dom';

export function makeTabs(root: HTMLElement): void {
  const tabs = [...root.querySelectorAll<HTMLButtonElement>('[role="tab"]')];
  const show = (chosen: HTMLButtonElement): void => {
    for (const tab of tabs) {
      const isIt = tab === chosen;
      tab.ariaSelected = String(isIt);
      tab.tabIndex = isIt ? 0 : -1;
      element(`#${tab.getAttribute('aria-controls')}`, HTMLElement).hidden = !isIt;
    }
  };
  tabs.forEach((tab, k) => {
    tab.addEventListener('click', () => show(tab));
    tab.addEventListener('keydown', ({ key }) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[key];
      if (!step) return;
      const next = tabs[(k + step + tabs.length) % tabs.length]!;
      show(next);
      next.focus();
    });
  });
  show(tabs[0]!);
}
