// Elements of the page in one call.
type Child = Node | string | undefined | false;
type Attributes = Record<string, string | number | boolean | undefined | ((event: never) => void)>;

/** An element with attributes and children; a function is a listener, `false` and undefined leave an attribute out. */
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag, attributes: Attributes = {}, ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name, value as EventListener);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== undefined && value !== false) made.setAttribute(name, String(value));
  }
  made.append(...children.filter((child) => child !== undefined && child !== false));
  return made;
}

/** A button with a name for people who do not see its sign. */
export function button(text: string, title: string, press: () => void, more: Attributes = {}): HTMLButtonElement {
  return element("button", { type: "button", title, "aria-label": title, click: press, ...more }, text);
}

/** A choice among names; `meaning` is shown for each. */
export function choice(
  label: string, names: readonly { value: string; text: string }[], value: string, pick: (value: string) => void,
): HTMLSelectElement {
  const select = element("select", { "aria-label": label, title: label });
  for (const name of names) select.append(element("option", { value: name.value, selected: name.value === value }, name.text));
  select.addEventListener("change", () => pick(select.value));
  return select;
}

/** Saves bytes or text under a name. */
export function save(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
  const link = element("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** Reads aloud what has happened, and shows it for some seconds. */
export function announce(text: string): void {
  const place = document.querySelector<HTMLElement>("#announce");
  if (!place) return;
  place.textContent = text;
  place.classList.add("shown");
  setTimeout(() => {
    if (place.textContent === text) place.classList.remove("shown");
  }, 4000);
}
