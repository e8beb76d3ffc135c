/** Returns a colour of the style sheet in the current scheme, as a canvas does not follow the scheme. */
export function pageColor(name: string): string {
  const probe = document.createElement("i");
  probe.style.color = `var(--${name})`;
  document.body.append(probe);
  const value = getComputedStyle(probe).color;
  probe.remove();
  return value;
}
