"""The words of a protocol in its languages."""

from __future__ import annotations

from railgrip.core.errors import RailgripError, unknown_name

ENGLISH = {
    "title": "Test protocol: wheel-slide protection",
    "simulation": "simulation, not an approval",
    "result": "Result",
    "all_kept": "All limits kept.",
    "some_missed": "Limits missed: {missed} of {all}.",
    "incomplete": "Tests that could not be completed: {count}.",
    "summary": "{tests} tests, {runs} runs, {invalid_runs} of them invalid and repeated.",
    "identification": "Identification",
    "item": "Item",
    "value": "Value",
    "version": "railgrip",
    "controller": "Controller",
    "controller_hash": "Hash of its sources",
    "parameters": "Parameters",
    "profile": "Profile",
    "profile_source": "Its source",
    "profile_hash": "Hash of the profile",
    "seed": "Seed",
    "vehicle": "Vehicle",
    "axles": "Axles",
    "mass": "Mass, t",
    "length": "Length, m",
    "v_max": "Greatest speed, km/h",
    "teeth": "Teeth of the pole wheel",
    "valve_delays": "Valve delays vent, fill, ms",
    "tests": "Tests and verdicts",
    "test": "Test",
    "limit": "Limit",
    "measured": "Measured",
    "margin": "Margin",
    "verdict": "Verdict",
    "sure": "Confidence",
    "provenance": "Provenance of the limit",
    "kept": "kept",
    "missed": "missed",
    "not applicable": "not applicable",
    "each": "each run",
    "mean": "mean",
    "at_least": "at least",
    "at_most": "at most",
    "sure_each": "≥ {share:.0%} of all runs (95 %)",
    "sure_mean": "{share:.1%} that the mean keeps it",
    "figures": "Figures over the valid runs",
    "figure": "Figure",
    "mean_of": "Mean",
    "interval": "95 % of the mean",
    "least": "Least",
    "greatest": "Greatest",
    "speed": "Speed",
    "rail": "Rail",
    "faults": "Faults",
    "valid_when": "Valid when",
    "runs": "Runs",
    "valid_runs": "{valid} of {wanted} valid runs in {tried} tries",
    "run": "Run",
    "status": "End",
    "invalid": "invalid",
    "valid": "valid",
    "nearest": "Runs nearest to a limit",
    "nearest_note": "The 2 % of all runs that come nearest to a limit, on either side. "
    "railgrip qualify … --replay {example} runs one again with all its curves.",
    "infinite": "never",
    "over_time": "Speeds over time, km/h over s",
    "over_distance": "Speeds over distance, km/h over m",
    "slip": "Slip of the worst axle with its thresholds, %",
    "pressure": "Cylinder pressure mean and least, bar; valves that vent, of ten",
    "adhesion": "Adhesion used and available, mean over the axles",
    "air": "Least reservoir pressure, bar",
    "train": "train",
    "reference": "reference speed",
    "wheels": "slowest and fastest wheel",
    "used": "used",
    "available": "available",
    "pressure_mean": "mean",
    "pressure_least": "least",
    "venting": "venting",
    "reservoir": "least reservoir",
    "deviations": "Deviations, validity and assumptions",
    "signature": "Place, date, signature",
    "compared": "Compared",
    "before": "before",
    "after": "after",
    "newly_missed": "newly missed",
    "now_kept": "now kept",
}

GERMAN = {
    "title": "Prüfprotokoll: Gleitschutz",
    "simulation": "Simulation, keine Zulassung",
    "result": "Ergebnis",
    "all_kept": "Alle Grenzwerte eingehalten.",
    "some_missed": "Grenzwerte verfehlt: {missed} von {all}.",
    "incomplete": "Prüfungen, die nicht zu Ende kamen: {count}.",
    "summary": "{tests} Prüfungen, {runs} Läufe, davon {invalid_runs} ungültig und wiederholt.",
    "identification": "Kennzeichnung",
    "item": "Angabe",
    "value": "Wert",
    "version": "railgrip",
    "controller": "Regler",
    "controller_hash": "Prüfsumme seiner Quellen",
    "parameters": "Parameter",
    "profile": "Profil",
    "profile_source": "Seine Herkunft",
    "profile_hash": "Prüfsumme des Profils",
    "seed": "Startwert der Zufallszahlen",
    "vehicle": "Fahrzeug",
    "axles": "Radsätze",
    "mass": "Masse, t",
    "length": "Länge, m",
    "v_max": "Höchstgeschwindigkeit, km/h",
    "teeth": "Zähne des Polrads",
    "valve_delays": "Verzug der Ventile Lösen, Füllen, ms",
    "tests": "Prüfungen und Urteile",
    "test": "Prüfung",
    "limit": "Grenzwert",
    "measured": "Gemessen",
    "margin": "Abstand",
    "verdict": "Urteil",
    "sure": "Vertrauen",
    "provenance": "Herkunft des Grenzwerts",
    "kept": "eingehalten",
    "missed": "verfehlt",
    "not applicable": "nicht anwendbar",
    "each": "jeder Lauf",
    "mean": "Mittel",
    "at_least": "mindestens",
    "at_most": "höchstens",
    "sure_each": "≥ {share:.0%} aller Läufe (95 %)",
    "sure_mean": "{share:.1%}, dass das Mittel ihn hält",
    "figures": "Kennwerte der gültigen Läufe",
    "figure": "Kennwert",
    "mean_of": "Mittel",
    "interval": "95 % des Mittels",
    "least": "Kleinster",
    "greatest": "Größter",
    "speed": "Geschwindigkeit",
    "rail": "Schiene",
    "faults": "Störungen",
    "valid_when": "Gültig wenn",
    "runs": "Läufe",
    "valid_runs": "{valid} von {wanted} gültigen Läufen in {tried} Versuchen",
    "run": "Lauf",
    "status": "Ende",
    "invalid": "ungültig",
    "valid": "gültig",
    "nearest": "Läufe, die einem Grenzwert am nächsten kommen",
    "nearest_note": "Die 2 % aller Läufe, die einem Grenzwert von einer der Seiten am nächsten "
    "kommen. railgrip qualify … --replay {example} wiederholt einen mit allen Kurven.",
    "infinite": "nie",
    "over_time": "Geschwindigkeiten über der Zeit, km/h über s",
    "over_distance": "Geschwindigkeiten über dem Weg, km/h über m",
    "slip": "Schlupf des schlechtesten Radsatzes mit Schwellen, %",
    "pressure": "C-Druck Mittel und kleinster, bar; lösende Ventile, von zehn",
    "adhesion": "Kraftschluss benutzt und verfügbar, Mittel der Radsätze",
    "air": "Kleinster Behälterdruck, bar",
    "train": "Zug",
    "reference": "Referenzgeschwindigkeit",
    "wheels": "langsamstes und schnellstes Rad",
    "used": "benutzt",
    "available": "verfügbar",
    "pressure_mean": "Mittel",
    "pressure_least": "kleinster",
    "venting": "lösend",
    "reservoir": "kleinster Behälter",
    "deviations": "Abweichungen, Gültigkeit und Annahmen",
    "signature": "Ort, Datum, Unterschrift",
    "compared": "Vergleich",
    "before": "vorher",
    "after": "nachher",
    "newly_missed": "neu verfehlt",
    "now_kept": "jetzt eingehalten",
}

LANGUAGES = {"en": ENGLISH, "de": GERMAN}

ASSUMPTIONS = {
    "en": (
        "A simulation on one plant model: contact after the creep law named in the scenario, rail "
        "conditions as shipped (their numbers carry their provenance), pole-wheel sensors and "
        "valves with delays, brake discs of two nodes. It holds between standstill and the "
        "greatest speed of the train, for slip in braking and driving on straight track.",
        "The profile follows public descriptions of such programmes. Its limits are not those of "
        "a standard unless their provenance says so. Nothing here has been approved by anybody.",
        "Initial adhesion is the adhesion used in the first second of slide, mean of the first "
        "four braked wheelsets. Distances are corrected for initial speed and gradient.",
        "Wheel flats follow from friction work while a wheel is locked, with an illustrative wear "
        "rate: they compare, they do not measure.",
    ),
    "de": (
        "Eine Simulation an einem Modell von Zug und Schiene: Kontakt nach dem "
        "Kraftschlussgesetz des Szenarios, Schienenzustände wie mitgeliefert (ihre Zahlen "
        "nennen ihre Herkunft), Polradgeber und Ventile mit Verzug, Bremsscheiben mit zwei "
        "Knoten. Sie gilt vom Stillstand bis zur Höchstgeschwindigkeit des Zuges, für Gleiten "
        "und Schleudern "
        "im geraden Gleis.",
        "Das Profil folgt öffentlichen Beschreibungen solcher Prüfungen. Seine Grenzwerte sind "
        "nicht die einer Norm, wo ihre Herkunft es nicht sagt. Niemand hat hier etwas zugelassen.",
        "Anfangskraftschluss ist der in der ersten Sekunde des Gleitens benutzte Kraftschluss, "
        "Mittel der ersten vier gebremsten Radsätze. Wege sind auf Anfangsgeschwindigkeit und "
        "Neigung korrigiert.",
        "Flachstellen folgen aus der Reibarbeit blockierter Räder mit einer beispielhaften "
        "Verschleißrate: sie vergleichen, sie messen nicht.",
    ),
}
"""What every protocol says of the simulation, sentence by sentence."""


def words(language: str) -> dict[str, str]:
    """Return the words of a language.

    Raises
    ------
    RailgripError
        ``--language: language 'fr' unknown; known: de, en``

    Examples
    --------
    >>> words("de")["missed"]
    'verfehlt'
    """
    if language not in LANGUAGES:
        raise RailgripError(unknown_name("--language", "language", language, LANGUAGES))
    return LANGUAGES[language]
