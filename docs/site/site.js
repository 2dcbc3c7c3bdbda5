// Filters the table of statements. Without it the page is the whole table.
"use strict";

(() => {
  const form = document.getElementById("filter");
  const table = document.getElementById("rows");
  const rows = [...table.tBodies[0].rows];
  const fields = ["words", "section", "verdict"].map((name) => document.getElementById(name));
  const formulas = document.getElementById("formulas");
  const count = document.getElementById("count");
  const none = document.getElementById("none");

  function show() {
    const [words, section, verdict] = fields.map((field) => field.value);
    const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of rows) {
      const fits =
        (!section || row.dataset.section === section) &&
        (!verdict || row.dataset.verdict === verdict) &&
        wanted.every((word) => row.dataset.words.includes(word));
      row.hidden = !fits;
      shown += fits;
    }
    table.classList.toggle("bare", !formulas.checked);
    table.hidden = shown === 0;
    none.hidden = shown > 0;
    count.textContent = `${shown} of ${rows.length} statements`;
  }

  // The filter stands in the address, so that it can be kept and sent.
  function remember() {
    const said = new URLSearchParams();
    for (const field of fields) if (field.value) said.set(field.id, field.value);
    const address = said.size ? `#${said}` : "#";
    if (location.hash !== address && !(address === "#" && !location.hash)) {
      history.replaceState(null, "", address);
    }
  }

  function recall() {
    if (location.hash && !location.hash.includes("=")) return; // an anchor, as of the skip link
    const said = new URLSearchParams(location.hash.slice(1));
    for (const field of fields) {
      field.value = said.get(field.id) ?? "";
      if (field.selectedIndex === -1) field.value = "";
    }
    show();
  }

  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("input", () => { show(); remember(); });
  form.addEventListener("reset", () => setTimeout(() => { show(); remember(); }));
  addEventListener("hashchange", recall);
  form.hidden = false;
  recall();
})();
