"""What a picture is, who draws it, and how many points a screen can show."""
