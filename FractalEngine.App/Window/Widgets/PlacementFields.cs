using FractalEngine.App.Window.Actions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>Sliders for position, rotation and scale of an object, on which numbers can be typed.</summary>
internal sealed class PlacementFields(WindowActions actions)
{
    // The placement at the beginning of a drag, around which the sliders reach.
    private int _startInteraction = -1;
    private Transformation _startPlacement;

    /// <summary>Adds nine sliders, of which each change is a step that can be undone.</summary>
    /// <param name="ui">The interface that is being built.</param>
    /// <param name="declared">The object as the scene declares it.</param>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    public void Build(UserInterface ui, SceneObject declared, int index)
    {
        if (ui.Interaction != _startInteraction)
        {
            _startInteraction = ui.Interaction;
            _startPlacement = declared.Placement;
        }

        var placement = declared.Placement;
        var bounds = actions.Document!.File.Scene.Bounds;
        var reach = bounds.Size.IsFinite() && !bounds.IsEmpty ? Math.Max(1e-6, 0.5 * bounds.Diagonal) : 10;
        var position = ui.Vector("position", placement.Position, _startPlacement.Position, reach, 0);
        var rotation = ui.Vector("rotation in degrees", placement.Rotation, _startPlacement.Rotation, 180, 1);
        var scale = ui.Vector("scale", placement.Scale, _startPlacement.Scale, null, 0.01);
        if (new Transformation(position, rotation, scale) == placement)
        {
            return;
        }

        // Only what was changed here: an earlier change of the rest may still be loading.
        actions.ChangeObject(index, present => present.MovedTo(new(
            PanelWidgets.Merge(present.Placement.Position, placement.Position, position),
            PanelWidgets.Merge(present.Placement.Rotation, placement.Rotation, rotation),
            PanelWidgets.Merge(present.Placement.Scale, placement.Scale, scale))));
    }
}
