// Link, pictures, numbers, and the lines that give the same result elsewhere.
import { commandLine, fileOf, pythonLines } from "../commands.ts";
import { announce, button, element, save } from "../dom.ts";
import type { ModelCard } from "../protocol.ts";
import { isText, type Settings } from "../settings.ts";

/** A view that can be saved. */
export interface Saved {
  name: string;
  svg(): string;
  png?(): Promise<Blob>;
  csv?(): string;
}

async function copied(text: string, what: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    announce(`${what} copied`);
  } catch {
    announce("the browser does not allow copying: select the text and copy it");
  }
}

export class SharePanel {
  readonly host = element("dialog", { class: "share", "aria-label": "share and save" });

  show(settings: Settings, card: ModelCard, views: readonly Saved[]): void {
    const link = location.href, embed = `<iframe src="${link.replace("#", "?embed#")}" width="900" height="620" style="border:0" title="${card.name}"></iframe>`;
    this.host.replaceChildren(
      element("header", {}, element("h2", {}, "Share and save"), button("×", "close", () => this.host.close(), { class: "plain" })),
      this.block("Link to this page as it is", link), this.block("To embed it in slides", embed),
      this.block("Command line", commandLine(settings, card)), this.block("Python", pythonLines(settings, card)),
      element("h3", {}, "Pictures and numbers"), this.files(views, card.name),
    );
    if (isText(settings.source))
      this.host.append(button("Save the model file", "save the model file", () => save(fileOf(card), new Blob([settings.source]))));
    this.host.showModal();
  }

  private block(title: string, text: string): HTMLElement {
    return element("section", {}, element("h3", {}, title), button("Copy", `copy: ${title}`, () => void copied(text, title)), element("pre", { tabindex: 0, role: "region", "aria-label": title }, text));
  }

  private files(views: readonly Saved[], model: string): HTMLElement {
    const rows = views.map((view) => {
      const { svg, png, csv } = view;
      return element("tr", {}, element("th", { scope: "row" }, view.name),
        element("td", {}, button("SVG", `save ${view.name} as SVG`, () => save(`${model}-${view.name}.svg`, new Blob([svg()], { type: "image/svg+xml" })))),
        element("td", {}, png ? button("PNG", `save ${view.name} as PNG`, () => void png().then((blob) => save(`${model}-${view.name}.png`, blob))) : ""),
        element("td", {}, csv ? button("CSV", `save ${view.name} as CSV`, () => save(`${model}-${view.name}.csv`, new Blob([csv()], { type: "text/csv" }))) : ""));
    });
    return element("table", {}, element("tbody", {}, ...rows));
  }
}
