"""What a verdict on a pair of material and surface rests on."""
