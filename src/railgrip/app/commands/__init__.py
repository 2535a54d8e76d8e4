"""One file a command; heavy libraries are imported inside the functions only."""
