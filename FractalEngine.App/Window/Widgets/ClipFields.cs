using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.State;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>The near and the far clip plane of a scene, in the panel of the view. They belong to the scene's file.</summary>
internal sealed class ClipFields(WindowActions actions)
{
    /// <summary>Adds a check box, and the two depths where they are fixed.</summary>
    public void Build(UserInterface ui, Document document)
    {
        if (document.File.Kind != FileKind.Scene)
        {
            return;
        }

        var clip = document.File.Scene.Scene.Clip;
        ui.Row(1);
        if (ui.CheckBox("Fixed clip planes", clip is not null))
        {
            var planes = document.LatestView is { } view
                ? document.Renderer.ClipPlanes(view, ui.Width, ui.Height, actions.Settings)
                : (0.1, 1000);
            (double Near, double Far)? rounded = clip is null ? (Math.Round(planes.Near, 6), Math.Round(planes.Far, 6)) : null;
            actions.ChangeScene(scene => scene with { Clip = rounded });
        }

        ui.Tooltip("depths between which the scene is drawn; otherwise they follow the size of the scene");
        if (clip is not var (near, far))
        {
            return;
        }

        ui.Row(1, 1);
        var size = document.File.Scene.Bounds.FiniteDiagonalOr(1);
        var isChanged = ui.Slider("near", ref near, 1e-3 * size, size, isBounded: false)
            | ui.Slider("far", ref far, 1e-3 * size, 10 * size, isBounded: false);
        if (isChanged && near > 0 && near < far)
        {
            var (shownNear, shownFar) = clip.Value;
            // The other one may have changed too, and not be loaded yet.
            actions.ChangeScene(scene => scene with
            {
                Clip = (near.Equals(shownNear) && scene.Clip is { } before ? before.Near : near,
                    far.Equals(shownFar) && scene.Clip is { } other ? other.Far : far),
            });
        }
    }
}
