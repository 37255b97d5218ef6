"""The points of a measured loop: order, averages, noise, signs and what they show by themselves."""
