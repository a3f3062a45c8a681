"""From radiance to what the eye gets: the display, its code values, and what is lost on the way (book chapter 5)."""
