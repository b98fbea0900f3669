"""What tests/tools/use_addon.py does in Blender, a module for each subject."""
