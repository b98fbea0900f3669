// The materials of a body's look: the display mesh that the scene names.

import { Color, DoubleSide, MeshStandardMaterial, RepeatWrapping, SRGBColorSpace, Texture } from 'three';

/** Returns the mean colour of an image, linear. */
function meanColor(image) {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [1, 1];
    const pen = canvas.getContext('2d');
    pen.imageSmoothingQuality = 'high';
    pen.drawImage(image, 0, 0, 1, 1);
    const [red, green, blue] = pen.getImageData(0, 0, 1, 1).data;
    return new Color().setRGB(red / 255, green / 255, blue / 255, SRGBColorSpace);
}

/**
 * Returns a material for each slot of the body's look, and one of their mean colour for coarser surfaces. `loaded` is called
 * whenever an image has arrived.
 */
export function materialsOf({ look, normals }, loaded) {
    const share = look.materials.reduce((sum, { triangles }) => sum + triangles, 0);
    const coarse = new MeshStandardMaterial({ color: '#000000', roughness: 0.6, metalness: 0, side: DoubleSide });
    const addToMean = (color, triangles) => { coarse.color.add(color.clone().multiplyScalar(triangles / share)); };
    const textures = look.images.map((blob) => {
        const texture = new Texture();
        texture.colorSpace = SRGBColorSpace;
        texture.wrapS = texture.wrapT = RepeatWrapping;
        texture.image = new Image();
        texture.image.src = URL.createObjectURL(blob);
        return texture;
    });
    const materials = look.materials.map(({ color, image, cut_out: cutOut, blended, triangles }) => {
        const [red, green, blue, opacity] = color;
        const material = new MeshStandardMaterial({
            roughness: 0.6, metalness: 0, side: DoubleSide, flatShading: normals.length === 0, opacity, transparent: blended,
            alphaTest: cutOut ? 0.5 : 0,
        });
        material.color.setRGB(red, green, blue);
        if (image < 0) {
            addToMean(material.color, triangles);
            return material;
        }
        const texture = textures[image];
        material.map = texture;
        texture.image.decode().then(() => {
            texture.needsUpdate = true;
            addToMean(meanColor(texture.image).multiply(material.color), triangles);
            loaded();
        }, () => {  // no browser reads it
            material.map = null;
            material.needsUpdate = true;
            loaded();
        });
        return material;
    });
    return { materials, coarse };
}
