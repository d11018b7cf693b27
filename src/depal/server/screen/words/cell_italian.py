"""The cell's own sentences in Italian; names of boxes, products and places stand in braces."""

from typing import Final

CELL_ITALIAN: Final[tuple[tuple[str, str], ...]] = (
    # Why it is in its mode
    ("No delivery is started.", "Nessuna consegna avviata."),
    ("Boxes are being moved.", "Le scatole vengono spostate."),
    ("The pallet is empty.", "Il pallet è vuoto."),
    ("A safety stop is active.", "È attivo un arresto di sicurezza."),
    ("Stopped after a box. Press Start to go on.", "Ferma dopo una scatola. Premi Avvia."),
    ("Held by a person. Press Resume to go on.", "In pausa. Premi Riprendi."),
    (
        "The controller was started anew. Press Start to go on.",
        "Il controllo è ripartito. Premi Avvia per continuare.",
    ),
    # Alarms
    ("Answer the question.", "Rispondi alla domanda."),
    ("Look at the cell, then press Start.", "Guarda la cella, poi premi Avvia."),
    ("Look at the cell, then start it anew.", "Guarda la cella, poi avviala di nuovo."),
    ("Load the pallet anew, then press Start.", "Rimetti il pallet, poi premi Avvia."),
    (
        "The controller was started anew; the sensors say: {found}",
        "Il controllo è ripartito; i sensori dicono: {found}",
    ),
    ("The run has failed: {reason}", "Il lavoro non è riuscito: {reason}"),
    (
        "Run {run} cannot be taken up: the world that it ran in has ended.",
        "Il lavoro {run} non si può riprendere: il suo mondo è finito.",
    ),
    (
        "Something stands in {place} that the cell has not put there.",
        "In {place} c'è qualcosa che la cella non ci ha messo.",
    ),
    ("Take it out.", "Toglilo."),
    # Questions
    (
        "The arm cannot take box {box}: {reason}. Please take it off the pallet.",
        "Il braccio non può prendere la scatola {box}: {reason}. Toglila dal pallet.",
    ),
    (
        (
            "The note promises one more case of {name} ({gtin}), and none is seen. "
            "Please take it off the pallet, or off the floor, if it is there."
        ),
        (
            "La bolla promette un altro collo di {name} ({gtin}) e non si vede. "
            "Se c'è, toglilo dal pallet o dal pavimento."
        ),
    ),
    (
        "{trolley} is full. Please pull it out and put an empty one into its bay.",
        "{trolley} è pieno. Tiralo fuori e metti un carrello vuoto al suo posto.",
    ),
    (
        "Which product is the box in the gripper ({box})? {reason}.",
        "Quale prodotto è la scatola nella pinza ({box})? {reason}.",
    ),
    ("Box {box}: {reason}. Please pick it up.", "Scatola {box}: {reason}. Raccoglila."),
    (
        "The arm cannot put box {box} down: {reason}. Please take it out of the gripper.",
        "Il braccio non può posare la scatola {box}: {reason}. Toglila dalla pinza.",
    ),
    (
        "Box {box} was set aside: {reason}. Please take it away.",
        "La scatola {box} è stata messa da parte: {reason}. Portala via.",
    ),
    (
        "The cell is held: {reason}. Please see to it.",
        "La cella è in pausa: {reason}. Controlla, per favore.",
    ),
    (
        (
            "The cell was started anew while it moved box {box}, and its sensors cannot tell where "
            "that is. Where is it?"
        ),
        "La cella è ripartita mentre spostava la scatola {box} e i sensori non sanno dov'è. Dov'è?",
    ),
    (
        (
            "The arm has stopped: {reason}. Please see that nobody is in the cell, clear the "
            "cause, reset it, and say start."
        ),
        (
            "Il braccio si è fermato: {reason}. Controlla che nella cella non ci sia nessuno, "
            "elimina la causa, ripristina e conferma l'avvio."
        ),
    ),
    ("trolley_{number}", "Il carrello {number}"),
    # Answers
    ("start", "avvia"),
    ("it cannot go on now", "adesso non può continuare"),
    ("taken", "l'ho presa"),
    ("done", "fatto"),
    ("yes", "sì"),
    ("no", "no"),
    ("it is not there", "non c'è"),
    ("I cannot tell", "non lo so"),
    ("I have seen to it", "ho controllato"),
    ("that cannot be helped now", "adesso non si può"),
    ("it hangs in the gripper", "è nella pinza"),
    ("it stands in its place", "è al suo posto"),
    ("it stands on the pallet", "è sul pallet"),
    # Why a box, or not
    ("the best score of all boxes that can be grasped", "il miglior punteggio fra le prendibili"),
    ("scored lower than {box}", "punteggio più basso di {box}"),
    ("scored lower", "punteggio più basso"),
    ("not selected yet", "non ancora valutata"),
    ("no reachable grasp", "nessuna presa possibile"),
    ("{boxes} on top", "{boxes} sopra"),
    ("{boxes} in front", "{boxes} davanti"),
    ("{boxes} where the tool has to go", "{boxes} dove deve passare la pinza"),
    ("something that nobody knows may stand on it", "forse ha sopra qualcosa di sconosciuto"),
    ("one of its edges is a guess", "uno dei suoi bordi è incerto"),
    ("only the last look has shown it", "l'ha mostrata solo l'ultima immagine"),
    ("it was tried in vain", "si è provato invano"),
    ("the last look did not show it", "l'ultima immagine non la mostra"),
    ("no product of the note has its size", "nessun prodotto della bolla ha la sua misura"),
    ("it lies on the floor", "è a terra"),
    ("there is no place for it", "non c'è posto per lei"),
    ("the barcode was not read", "il codice non è stato letto"),
    ("no look showed it", "non si è mai vista"),
    # What cannot be done
    ("the cell is working", "la cella sta già lavorando"),
    ("the cell is {mode} already", "la cella è già così: {mode}"),
    ("no delivery is being worked on", "nessuna consegna in lavorazione"),
    ("no delivery waits; add one to the queue", "nessuna consegna in attesa: caricane una"),
    ("delivery {name} is not finished yet", "la consegna {name} non è ancora finita"),
    (
        "{by} has answered this question already: {choice}",
        "{by} ha già risposto a questa domanda: {choice}",
    ),
    ("request {key} has been served already", "la richiesta {key} è già stata servita"),
    (
        "a safety stop is active; it is released at the cell, not from here",
        "è attivo un arresto di sicurezza: si sblocca alla cella, non da qui",
    ),
)
