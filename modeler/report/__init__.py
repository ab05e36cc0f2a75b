"""Results for people: pages without network, figures, notebook tables, the robot as it looks."""
