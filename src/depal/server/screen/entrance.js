// Sends the form as JSON to the API; a session cookie comes back, then the screen opens.
const form = document.getElementById("form");
const wrong = document.getElementById("wrong");
form.querySelector("input:not([type=hidden])").focus();
form.addEventListener("submit", async (event) => {
  event.preventDefault();
  const button = form.querySelector("button");
  button.disabled = true;
  wrong.textContent = "";
  try {
    const answer = await fetch(form.dataset.address, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(Object.fromEntries(new FormData(form))),
    });
    if (answer.ok) {
      location.replace("/");
      return;
    }
    const problem = await answer.json();
    const parts = (problem.problems || []).map((each) =>
      `${each.where}: ${each.what}` +
      (each.expected ? `; ${wrong.dataset.expected} ${each.expected}` : ""));
    wrong.textContent = parts.join(". ") || problem.detail || problem.title || answer.statusText;
  } catch {
    wrong.textContent = wrong.dataset.away;
  }
  button.disabled = false;
});
