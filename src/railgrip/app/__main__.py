"""`python -m railgrip.app` is the same as `railgrip`."""

from railgrip.app.cli import main

main()
