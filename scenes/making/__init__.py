"""Makes the files that the scenes need: textures as PNG, the furnished room as glTF."""
